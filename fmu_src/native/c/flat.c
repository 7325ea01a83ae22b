#include "flat.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "table_file.h"

#define PI 3.14159265358979323846
#define INTERVALS 2000 /* along the rail and along the tread of a rolled flat */

static double tread_drop(const rc_flat *flat, double s)
{
    if (flat->shape == RC_MEASURED)
        return rc_curve_at(&flat->measured, s);
    const double a = fabs(s) / flat->half_length;
    if (!(a < 1.0))
        return 0.0;
    if (flat->shape == RC_HAVERSINE)
        return flat->depth * (0.5 * (1.0 + cos(PI * a)));
    if (flat->shape == RC_PARABOLA)
        return flat->depth * (1.0 - a * a);
    return flat->depth * ((1.0 - a) * (1.0 - a));
}

/* How far ahead a point of this drop touches the rail; zero unless it is raised. */
static double reach(double least_drop, double radius)
{
    return sqrt(2.0 * radius * fmax(0.0, -least_drop));
}

static void space_evenly(double *points, double first, double last)
{
    const double spacing = (last - first) / INTERVALS;
    for (int k = 0; k < INTERVALS; ++k)
        points[k] = k * spacing + first;
    points[INTERVALS] = last;
}

/* The path of the wheel's centre, e(x) = min over s of r(s) + (s - x)^2 / (2 R). */
static int roll(rc_flat *flat, double first, double last)
{
    const size_t count = INTERVALS + 1;
    double *tread = malloc(sizeof(double) * 4 * count);
    if (tread == NULL)
        return 0;
    double *drop = tread + count, *position = drop + count, *path = position + count;
    double least = INFINITY;
    space_evenly(tread, first, last);
    for (size_t k = 0; k < count; ++k) {
        drop[k] = tread_drop(flat, tread[k]);
        least = fmin(least, drop[k]);
    }
    const double early = reach(least, flat->radius);
    space_evenly(position, first - early, last + early);
    for (size_t i = 0; i < count; ++i) {
        const double x = position[i];
        double lowest = tread_drop(flat, x);
        for (size_t k = 0; k < count; ++k) {
            const double s = tread[k] - x, drop_there = drop[k] + s * s / (2.0 * flat->radius);
            lowest = drop_there < lowest ? drop_there : lowest;
        }
        path[i] = lowest;
    }
    const int made = rc_make_linear(&flat->path, position, path, count);
    free(tread);
    return made;
}

static int is_file(const char *name)
{
    const size_t length = strlen(name);
    if (length < 4 || name[length - 4] != '.')
        return 0;
    const char *end = name + length - 3;
    return (end[0] | 32) == 'c' && (end[1] | 32) == 's' && (end[2] | 32) == 'v';
}

static int choose_shape(rc_flat *flat, char *message, size_t room)
{
    static const struct {
        const char *name;
        rc_flat_shape shape;
    } known[] = {{"none", RC_NO_FLAT},    {"haversine", RC_HAVERSINE}, {"parabola", RC_PARABOLA},
                 {"cusp", RC_CUSP},       {"chord", RC_PARABOLA}};
    if (is_file(flat->shape_name)) {
        flat->shape = RC_MEASURED;
        return 1;
    }
    for (size_t i = 0; i < sizeof known / sizeof known[0]; ++i)
        if (strcmp(flat->shape_name, known[i].name) == 0) {
            flat->shape = known[i].shape;
            return 1;
        }
    snprintf(message, room, "flat shape is '%s'; it must be one of none, haversine, parabola, "
                            "cusp, chord or the path of a CSV file", flat->shape_name);
    return 0;
}

/* Reads a measured profile; its extent and its least and largest drop. */
static int read_profile(rc_flat *flat, double extent[2], double range[2], char *message,
                        size_t room)
{
    static const rc_table_kind kind = {"wheel profile", "distance [m]", "drop [m]", 4, 2};
    rc_table table;
    if (!rc_read_table(&table, flat->shape_name, &kind, message, room))
        return 0;
    range[0] = range[1] = table.y[0];
    for (size_t i = 1; i < table.rows; ++i) {
        range[0] = fmin(range[0], table.y[i]);
        range[1] = fmax(range[1], table.y[i]);
    }
    extent[0] = table.x[0];
    extent[1] = table.x[table.rows - 1];
    int good = 0;
    if (table.y[0] != 0.0 || table.y[table.rows - 1] != 0.0)
        snprintf(message, room, "wheel profile: the drop must be zero at both ends, where the "
                                "round tread goes on: add such points");
    else if (!(range[1] > 0.0))
        snprintf(message, room, "wheel profile: the largest drop is %g m; it must be above zero "
                                "somewhere: a drop is positive where metal is missing, change the "
                                "sign", range[1]);
    else if (!rc_make_monotone(&flat->measured, table.x, table.y, table.rows))
        snprintf(message, room, "wheel profile: there is not enough memory for it");
    else
        good = 1;
    rc_free_table(&table);
    return good;
}

static int check_parameters(const rc_flat *flat, char *message, size_t room)
{
    if (!(isfinite(flat->length) && flat->length > 0.0))
        snprintf(message, room, "flat length is %g m; it must be a finite number above zero: shape "
                                "'none' is a round wheel", flat->length);
    else if (!(isfinite(flat->depth) && flat->depth >= 0.0))
        snprintf(message, room, "flat depth is %g m; it is the missing material and must be a "
                                "finite number, not negative", flat->depth);
    else if (!isfinite(flat->position))
        snprintf(message, room, "flat position is %g m; it must be a finite number: give where its "
                                "centre meets the rail", flat->position);
    else
        return 1;
    return 0;
}

int rc_make_flat(rc_flat *flat, size_t wheels, char *message, size_t room)
{
    double extent[2] = {-0.5 * flat->length, 0.5 * flat->length};
    double range[2] = {0.0, 0.0};
    if (!check_parameters(flat, message, room) || !choose_shape(flat, message, room))
        return 0;
    if (flat->shape == RC_NO_FLAT)
        return 1;
    if (flat->wheel >= wheels) {
        snprintf(message, room, "the flat is on wheel %zu, the vehicle has %zu; give one of its "
                                "wheels, counted from 1", flat->wheel + 1, wheels);
        return 0;
    }
    if (strcmp(flat->shape_name, "chord") == 0)
        flat->depth = flat->length * flat->length / (8.0 * flat->radius);
    if (flat->shape == RC_MEASURED && !read_profile(flat, extent, range, message, room))
        return 0;
    const int measured = flat->shape == RC_MEASURED;
    const double depth = measured ? fmax(fabs(range[0]), fabs(range[1])) : flat->depth;
    double length = extent[1] - extent[0];
    if (measured && flat->rolled)
        length += 2.0 * reach(range[0], flat->radius);
    flat->half_length = 0.5 * flat->length;
    flat->turn = 2.0 * PI * flat->radius;
    if (length > flat->turn)
        snprintf(message, room, "the flat acts over %g m, the wheel's circumference is %g m; a "
                                "flat must fit on its wheel: give metres, not millimetres", length,
                 flat->turn);
    else if (depth >= flat->radius)
        snprintf(message, room, "the flat is %g m deep, the wheel's radius %g m; a flat must leave "
                                "a wheel: give metres, not millimetres", depth, flat->radius);
    else if (flat->rolled && !roll(flat, extent[0], extent[1]))
        snprintf(message, room, "there is not enough memory for the path of the flat wheel");
    else
        return 1;
    return 0;
}

double rc_flat_drop(const rc_flat *flat, double position)
{
    double s = position - flat->position;
    if (flat->periodic)
        s -= flat->turn * floor(s / flat->turn + 0.5);
    return flat->path.points > 0 ? rc_curve_at(&flat->path, s) : tread_drop(flat, s);
}

void rc_free_flat(rc_flat *flat)
{
    rc_free_curve(&flat->measured);
    rc_free_curve(&flat->path);
}
