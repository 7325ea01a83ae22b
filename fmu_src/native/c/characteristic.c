#include "characteristic.h"

#include <stdio.h>

#include "table_file.h"

#define POLE_SHARE 0.9 /* of the way to the pole of Eq. (26), where its tangent takes over */
#define FEWEST_POINTS 3

static rc_jet polynomial_at(const rc_characteristic *of, double displacement)
{
    const double x = displacement > 0.0 ? displacement : 0.0;
    const double a = of->alpha, b = of->beta, d = of->delta;
    return (rc_jet){.load = x * x * (a + x * (b + x * d)),
                    .tangent = x * (2.0 * a + x * (3.0 * b + x * 4.0 * d)),
                    .curvature =
                        displacement > 0.0 ? 2.0 * a + x * (6.0 * b + x * 12.0 * d) : 0.0};
}

static rc_jet hyperbola_at(const rc_characteristic *of, double displacement)
{
    const double k = of->stiffness, slope = of->slope, limit = POLE_SHARE / slope;
    const double pressed = displacement > 0.0 ? displacement : 0.0;
    const double x = pressed < limit ? pressed : limit, left = 1.0 - slope * x;
    const double tangent = k / (left * left) - k;
    const int inside = displacement > 0.0 && displacement < limit;
    return (rc_jet){.load = k * slope * x * x / left + tangent * (pressed - x),
                    .tangent = tangent,
                    .curvature = inside ? 2.0 * k * slope / (left * left * left) : 0.0};
}

static rc_jet table_at(const rc_characteristic *of, double displacement)
{
    double jet[3];
    rc_curve_along(&of->curve, displacement, jet);
    return (rc_jet){.load = jet[0] - of->stiffness * displacement,
                    .tangent = jet[1] - of->stiffness,
                    .curvature = jet[2]};
}

rc_jet rc_characteristic_at(const rc_characteristic *characteristic, double displacement)
{
    switch (characteristic->kind) {
    case RC_POLYNOMIAL:
        return polynomial_at(characteristic, displacement);
    case RC_HYPERBOLIC:
        return hyperbola_at(characteristic, displacement);
    case RC_TABLE:
        return table_at(characteristic, displacement);
    default:
        return (rc_jet){0.0, 0.0, 0.0};
    }
}

int rc_make_characteristic(rc_characteristic *characteristic, const char *what, const double *x,
                           const double *load, size_t points, char *message, size_t room)
{
    int has_origin = 0;
    if (points < FEWEST_POINTS) {
        snprintf(message, room, "%s: %zu points; at least %d are needed", what, points,
                 FEWEST_POINTS);
        return 0;
    }
    for (size_t i = 0; i < points; ++i) {
        has_origin |= x[i] == 0.0 && load[i] == 0.0;
        if (i > 0 && !(x[i] > x[i - 1] && load[i] > load[i - 1])) {
            snprintf(message, room, "%s: displacement and load must increase from point to point, "
                                    "but do not at point %zu", what, i + 1);
            return 0;
        }
    }
    if (!has_origin) {
        snprintf(message, room, "%s: the point 0 m, 0 N must be in the table", what);
        return 0;
    }
    characteristic->kind = RC_TABLE;
    if (rc_make_monotone(&characteristic->curve, x, load, points))
        return 1;
    snprintf(message, room, "%s: there is not enough memory for its table", what);
    return 0;
}

int rc_read_characteristic(rc_characteristic *characteristic, const char *what, const char *path,
                           char *message, size_t room)
{
    const rc_table_kind kind = {what, "displacement [m]", "load [N]", FEWEST_POINTS, 2};
    rc_table table;
    if (!rc_read_table(&table, path, &kind, message, room))
        return 0;
    const int made = rc_make_characteristic(characteristic, what, table.x, table.y, table.rows,
                                            message, room);
    rc_free_table(&table);
    return made;
}
