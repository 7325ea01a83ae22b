/* The tread of a wheel that is not round; twin of vehicle_fmu/out_of_roundness.py. */
#ifndef RC_TREAD_H
#define RC_TREAD_H

#include <stddef.h>

#include "curve.h"

typedef struct {
    rc_curve curve; /* of the length along the tread; none of a round wheel */
    double turn, first, position;
} rc_tread;

/* Makes the tread from its table of angles; 0 and a sentence if it is none. The angle zero meets
 * the rail at `position`. */
int rc_make_tread(rc_tread *tread, const char *path, double position, double radius, char *message,
                  size_t room);

/* Drop of the tread of a wheel at its position along the rail [m]. */
double rc_tread_drop(const rc_tread *tread, double position);

void rc_free_tread(rc_tread *tread);

#endif
