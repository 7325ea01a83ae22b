/* Hertz's law; twin of vehicle_fmu/contact.py. */
#ifndef RC_CONTACT_H
#define RC_CONTACT_H

#include <math.h>

static inline double rc_hertz_force(double compression, double coefficient)
{
    /* not fmax: a NaN must stay one and not pose as loss of contact */
    return compression < 0.0 ? 0.0 : coefficient * compression * sqrt(compression);
}

static inline double rc_hertz_compression(double force, double coefficient)
{
    const double root = cbrt(force / coefficient);
    return root * root;
}

/* dF/d(compression) at a compression. */
static inline double rc_hertz_stiffness(double compression, double coefficient)
{
    return compression < 0.0 ? 0.0 : 1.5 * coefficient * sqrt(compression);
}

#endif
