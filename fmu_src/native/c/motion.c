#include "motion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "table_file.h"

static int travel(rc_motion *motion, const rc_table *table)
{
    const size_t rows = table->rows;
    double *way = malloc(sizeof(double) * 3 * rows);
    if (way == NULL)
        return 0;
    double *slopes = way + rows;
    way[0] = 0.0;
    for (size_t i = 0; i + 1 < rows; ++i) {
        const double width = table->x[i + 1] - table->x[i];
        way[i + 1] = way[i] + 0.5 * (table->y[i] + table->y[i + 1]) * width;
        slopes[2 * i] = table->y[i];
        slopes[2 * i + 1] = table->y[i + 1];
    }
    const int made = rc_make_cubic(&motion->travelled, table->x, way, slopes, rows);
    free(way);
    return made;
}

static int read_speeds(rc_motion *motion, const char *path, char *message, size_t room)
{
    static const rc_table_kind kind = {"speed table", "time [s]", "speed [m/s]", 2, 2};
    rc_table table;
    if (!rc_read_table(&table, path, &kind, message, room))
        return 0;
    int good = 1;
    for (size_t i = 0; i < table.rows && good; ++i)
        if (!(table.y[i] > 0.0)) {
            snprintf(message, room, "speed table: the speed is %g m/s at %g s; it must be above "
                                    "zero: the vehicle must move forwards", table.y[i], table.x[i]);
            good = 0;
        }
    if (good && !travel(motion, &table)) {
        snprintf(message, room, "speed table: there is not enough memory for it");
        good = 0;
    }
    if (good) {
        motion->first_time = table.x[0];
        motion->first_speed = table.y[0];
        motion->last_time = table.x[table.rows - 1];
        motion->last_speed = table.y[table.rows - 1];
    }
    rc_free_table(&table);
    return good;
}

int rc_make_motion(rc_motion *motion, double speed, const char *path, char *message, size_t room)
{
    motion->speed = speed;
    if (path[0] != '\0')
        return read_speeds(motion, path, message, room);
    if (isfinite(speed) && speed > 0.0)
        return 1;
    snprintf(message, room, "speed is %g m/s; it must be a finite number above zero: the vehicle "
                            "must move forwards", speed);
    return 0;
}

static double from_first(const rc_motion *motion, double time)
{
    if (time < motion->first_time)
        return motion->first_speed * (time - motion->first_time);
    const double way = rc_curve_at(&motion->travelled, time);
    return time > motion->last_time ? way + motion->last_speed * (time - motion->last_time) : way;
}

double rc_distance(const rc_motion *motion, double start, double time)
{
    if (motion->travelled.points == 0)
        return motion->speed * (time - start);
    return from_first(motion, time) - from_first(motion, start);
}

void rc_free_motion(rc_motion *motion)
{
    rc_free_curve(&motion->travelled);
}
