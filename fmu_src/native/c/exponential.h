/* Exact step of the modal equations under a linearly varying load; twin of
 * track_fmu/exponential_step.py.
 *
 * q' = lambda q + Q0 + (Q1 - Q0) s / h has the solution q(h) = decay q(0) + start Q0 + end Q1.
 */
#ifndef RC_EXPONENTIAL_H
#define RC_EXPONENTIAL_H

#include "basis.h"
#include "supports.h"

#define RC_REMEMBERED_STEPS 32

/* What depends on the step size alone, and on the active supports. */
typedef struct {
    double step; /* s; 0: nothing is remembered here */
    int linear;
    uint64_t used;
    double *decay, *start, *end; /* rows */
    double *drive;               /* of a contact force: end, or start + end if it is held */
    double *drive_dual, *drive_rate;   /* w drive, w (lambda drive + 1): displacement and rate */
    double *end_dual, *end_rate;       /* likewise for `end` */
    double *drive_acceleration, *end_acceleration; /* w lambda (lambda drive + 1); if asked for */
    rc_active active;                  /* for which the following holds */
    double *coupling, *rate_coupling;  /* (stride, stride): per force increment at the end */
    double *acceleration_coupling;     /* likewise, if accelerations are asked for */
} rc_exponential;

typedef struct {
    rc_exponential slots[RC_REMEMBERED_STEPS];
    rc_exponential *last; /* looked at first */
    uint64_t clock;
} rc_exponentials;

/* The coefficients of a step size, worked out only if they are not remembered; `inertial` asks for
 * those of accelerations. `scratch` as for rc_modal_coupling. */
const rc_exponential *rc_coefficients(rc_exponentials *known, const rc_basis *basis, double step,
                                      int linear, int inertial, const rc_active *active,
                                      double *scratch);

#endif
