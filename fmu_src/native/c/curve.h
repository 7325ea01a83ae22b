/* Curves through tabulated points; twins of vehicle_fmu/interpolation.py. */
#ifndef RC_CURVE_H
#define RC_CURVE_H

#include <stddef.h>

/* A continuous piecewise cubic; constant beyond its ends. */
typedef struct {
    size_t points;  /* 0: there is no curve */
    double *breaks; /* points, then 4 coefficients of every piece, in one block of memory */
    double *pieces;
    double first, last;
} rc_curve;

/* Make a curve from points of strictly increasing x; 0 if there is not enough memory. */
int rc_make_linear(rc_curve *curve, const double *x, const double *y, size_t points);
int rc_make_monotone(rc_curve *curve, const double *x, const double *y, size_t points);
/* One period of a curve that goes on behind the last point at the first one, `period` further on
 * than it was. */
int rc_make_periodic(rc_curve *curve, const double *x, const double *y, size_t points,
                     double period);
/* `slopes` holds the slope at the left and at the right end of every piece. */
int rc_make_cubic(rc_curve *curve, const double *x, const double *y, const double *slopes,
                  size_t points);

double rc_curve_at(const rc_curve *curve, double x);

/* Value and first and second derivative; beyond its ends a curve goes on along its tangents. */
void rc_curve_along(const rc_curve *curve, double x, double jet[3]);

void rc_free_curve(rc_curve *curve);

#endif
