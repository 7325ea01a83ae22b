/* The way travelled as a function of time; twin of vehicle_fmu/speed.py. */
#ifndef RC_MOTION_H
#define RC_MOTION_H

#include <stddef.h>

#include "curve.h"

typedef struct {
    double speed;       /* where there is no table */
    rc_curve travelled; /* over time, where there is one */
    double first_time, first_speed, last_time, last_speed;
} rc_motion;

/* Makes the motion of a constant speed, or of the table of speeds at `path` if that is not "";
 * 0 and a sentence if that is impossible. */
int rc_make_motion(rc_motion *motion, double speed, const char *path, char *message, size_t room);

/* Way from `start` to `time` [m]. */
double rc_distance(const rc_motion *motion, double start, double time);

void rc_free_motion(rc_motion *motion);

#endif
