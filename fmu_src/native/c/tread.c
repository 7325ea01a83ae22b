#include "tread.h"

#include <math.h>
#include <stdio.h>

#include "table_file.h"

#define FULL_TURN (2.0 * 3.14159265358979323846)

static int check(const rc_table *table, char *message, size_t room)
{
    const double first = table->x[0], last = table->x[table->rows - 1];
    if (first >= 0.0 && last < FULL_TURN)
        return 1;
    snprintf(message, room, "out-of-roundness: the angle goes from %g to %g rad; it must be at "
                            "least 0 and below 2 pi: give radians, and leave out a last point "
                            "that is the first one again", first, last);
    return 0;
}

int rc_make_tread(rc_tread *tread, const char *path, double position, double radius, char *message,
                  size_t room)
{
    static const rc_table_kind kind = {"out-of-roundness", "angle [rad]", "drop [m]", 4,
                                       2};
    rc_table table;
    if (!rc_read_table(&table, path, &kind, message, room))
        return 0;
    int made = 0;
    if (check(&table, message, room)) {
        for (size_t i = 0; i < table.rows; ++i)
            table.x[i] = radius * table.x[i];
        tread->position = position;
        tread->turn = FULL_TURN * radius;
        tread->first = table.x[0];
        made = rc_make_periodic(&tread->curve, table.x, table.y, table.rows, tread->turn);
        if (!made)
            snprintf(message, room, "out-of-roundness: there is not enough memory for it");
    }
    rc_free_table(&table);
    return made;
}

double rc_tread_drop(const rc_tread *tread, double position)
{
    const double s = position - tread->position - tread->first;
    return rc_curve_at(&tread->curve, tread->first + (s - tread->turn * floor(s / tread->turn)));
}

void rc_free_tread(rc_tread *tread)
{
    rc_free_curve(&tread->curve);
}
