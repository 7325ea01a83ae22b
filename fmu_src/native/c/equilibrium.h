/* Static equilibrium of suspended bodies on wheels that stand at different heights; twin of
 * vehicle_fmu/equilibrium.py. */
#ifndef RC_EQUILIBRIUM_H
#define RC_EQUILIBRIUM_H

#include "suspension.h"

#define RC_SWAY 1.0 /* s; over which bodies smooth what they follow at the start */

/* What pushes a wheel down, static load minus contact force [N], and its contact's stiffness. */
typedef struct {
    double push, stiffness;
} rc_pressed;

typedef rc_pressed rc_footing(void *of, size_t wheel, double displacement);

typedef struct {
    const rc_suspension *suspension;
    double load;         /* static, of a wheel */
    rc_footing *footing; /* NULL for wheels that are held where they are */
    void *of;
} rc_settling;

/* Coordinates of bodies that ride on displaced wheels without any spring being moved. */
void rc_follow(const rc_suspension *own, const double *wheels, double *q);

/* Moves the coordinates to where nothing pushes any body, by Newton's iteration; 0 if it fails. */
int rc_settle(const rc_settling *of, double *q);

/* What every wheel is pressed with at rest beyond its static load; what is but rounding is zero. */
void rc_press_at_rest(const rc_suspension *own, const double *q, double load, double *pressed);

#endif
