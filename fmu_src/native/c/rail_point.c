#include "rail_point.h"

#include <math.h>

#include "rows.h"

int rc_locate(const rc_basis *basis, double position, rc_rail_point *point)
{
    if (!(position >= 0.0 && position <= basis->track_length))
        return 0;
    const double length = basis->element_length, phi = basis->shear_parameter;
    const double scaled = position / length, scale = 1.0 / (1.0 + phi);
    const size_t whole = (size_t)scaled, last = basis->elements - 1;
    point->element = whole < last ? whole : last;
    const double xi = scaled - (double)point->element, eta = 1.0 - xi;
    point->xi = xi;
    point->shape[0] = scale * (eta * (eta * (1.0 + 2.0 * xi) + phi));
    point->shape[1] = scale * (length * xi * eta * (eta + 0.5 * phi));
    point->shape[2] = scale * (xi * (xi * (1.0 + 2.0 * eta) + phi));
    point->shape[3] = scale * (-length * xi * eta * (xi + 0.5 * phi));
    point->slope[0] = scale * (-(6.0 * xi * eta + phi) / length);
    point->slope[1] = scale * (eta * (1.0 - 3.0 * xi) + 0.5 * phi * (eta - xi));
    point->slope[2] = scale * ((6.0 * xi * eta + phi) / length);
    point->slope[3] = scale * (xi * (3.0 * xi - 2.0) - 0.5 * phi * (eta - xi));
    return 1;
}

void rc_modes_at(const rc_basis *basis, const rc_rail_point *point, const double weights[4],
                 double *row)
{
    const size_t length = basis->length;
    const double *restrict a = rc_shape(basis, rc_first(point));
    const double *restrict b = a + length, *restrict c = b + length, *restrict d = c + length;
    const double wa = weights[0], wb = weights[1], wc = weights[2], wd = weights[3];
    double *restrict out = row;
    for (size_t k = 0; k < length; ++k)
        out[k] = (wa * a[k] + wb * b[k]) + (wc * c[k] + wd * d[k]);
}

double rc_residual(const rc_basis *basis, const rc_rail_point *point, size_t coordinate)
{
    const double *row = rc_flexibility(basis, coordinate) + rc_first(point);
    return (row[0] * point->shape[0] + row[1] * point->shape[1]) +
           (row[2] * point->shape[2] + row[3] * point->shape[3]);
}

double rc_residual_between(const rc_basis *basis, const rc_rail_point *at,
                           const double weights[4], const rc_rail_point *loaded,
                           const double load[4])
{
    double sum = 0.0;
    for (size_t k = 0; k < 4; ++k) {
        const double *row = rc_flexibility(basis, rc_first(at) + k) + rc_first(loaded);
        sum += weights[k] * ((row[0] * load[0] + row[1] * load[1]) +
                             (row[2] * load[2] + row[3] * load[3]));
    }
    return sum;
}
