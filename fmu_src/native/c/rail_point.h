/* Where a wheel stands on the rail; twin of track_fmu/contact_point.py. */
#ifndef RC_RAIL_POINT_H
#define RC_RAIL_POINT_H

#include "basis.h"

typedef struct {
    size_t element;
    double xi;       /* position within the element, 0..1 */
    double shape[4]; /* interpolation of the deflection from the element's two nodes */
    double slope[4]; /* and of its derivative by x */
} rc_rail_point;

/* Finds a track position; 0 if it is none. */
int rc_locate(const rc_basis *basis, double position, rc_rail_point *point);

/* The first of the four coordinates of the element. */
static inline size_t rc_first(const rc_rail_point *point)
{
    return 2 * point->element;
}

/* Modal displacement at the point, for `weights` its shape or its slope: a row. */
void rc_modes_at(const rc_basis *basis, const rc_rail_point *point, const double weights[4],
                 double *row);

/* Residual flexibility between the point and a coordinate, and between two points. */
double rc_residual(const rc_basis *basis, const rc_rail_point *point, size_t coordinate);
double rc_residual_between(const rc_basis *basis, const rc_rail_point *at,
                           const double weights[4], const rc_rail_point *loaded,
                           const double load[4]);

#endif
