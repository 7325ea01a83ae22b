/* Load over displacement of a component at rest, less its linear spring; twin of
 * track_fmu/characteristics.py. */
#ifndef RC_CHARACTERISTIC_H
#define RC_CHARACTERISTIC_H

#include "curve.h"

typedef enum { RC_LINEAR, RC_POLYNOMIAL, RC_HYPERBOLIC, RC_TABLE } rc_characteristic_kind;

typedef struct {
    rc_characteristic_kind kind;
    double stiffness;          /* N/m; of the linear spring */
    double alpha, beta, delta; /* N/m2, N/m3, N/m4: of RC_POLYNOMIAL */
    double slope;              /* 1/m: of RC_HYPERBOLIC */
    rc_curve curve;            /* of RC_TABLE */
} rc_characteristic;

/* A load [N] and its first and second derivative by displacement. */
typedef struct {
    double load, tangent, curvature;
} rc_jet;

rc_jet rc_characteristic_at(const rc_characteristic *characteristic, double displacement);

/* Reads the points of `what` from a file; 0 and a sentence if they make no curve. */
int rc_read_characteristic(rc_characteristic *characteristic, const char *what, const char *path,
                           char *message, size_t room);

/* The same from points that are read already. */
int rc_make_characteristic(rc_characteristic *characteristic, const char *what, const double *x,
                           const double *load, size_t points, char *message, size_t room);

#endif
