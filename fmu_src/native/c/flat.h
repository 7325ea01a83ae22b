/* The flat of a wheel; twin of vehicle_fmu/wheel_profile.py and rolling.py. */
#ifndef RC_FLAT_H
#define RC_FLAT_H

#include <stddef.h>

#include "curve.h"

typedef enum { RC_NO_FLAT, RC_HAVERSINE, RC_PARABOLA, RC_CUSP, RC_MEASURED } rc_flat_shape;

typedef struct {
    /* as given; a chord is a parabola of its own depth */
    double length, depth, position, radius;
    size_t wheel; /* from 0 */
    int periodic, rolled;
    const char *shape_name; /* or the path of a table */
    /* as made of it */
    rc_flat_shape shape;
    double half_length, turn;
    rc_curve measured, path;
} rc_flat;

/* Makes the profile; 0 and a sentence if these are no parameters of a flat of such a wheel. */
int rc_make_flat(rc_flat *flat, size_t wheels, char *message, size_t room);

/* Drop of the flat wheel's tread at its position along the rail [m]. */
double rc_flat_drop(const rc_flat *flat, double position);

void rc_free_flat(rc_flat *flat);

#endif
