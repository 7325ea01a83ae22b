/* Wheel masses under given contact forces, and the bodies above them; twin of
 * vehicle_fmu/masses.py and suspended_masses.py. */
#ifndef RC_MASSES_H
#define RC_MASSES_H

#include "instance.h"
#include "motion.h"
#include "suspension.h"

/* Groups of variables, in the order of the declaration. */
enum {
    SPEED, SPEED_TABLE,
    WHEEL_MASS, STATIC_WHEEL_LOAD, INITIAL_POSITION, SUBSTEP,
    OFFSET,
    SUSPENSION,
    CONTACT_FORCE = SUSPENSION + RC_SUSPENSION_PARAMETER_COUNT,
    STATIC_DISPLACEMENT, STATIC_VELOCITY, MEAN_VELOCITY,
    POSITION, DISPLACEMENT, VELOCITY, LOAD_CHANGE,
    BODIES,
    LINEAR_INPUTS = BODIES + RC_BODY_OUTPUT_COUNT
};

typedef struct {
    size_t wheels;
    rc_motion motion;
    rc_suspension suspension;
    double mass, load, initial_position, substep;
    double last_line, last_ahead; /* s; over which the last forces came to be known, and beyond */
    double last_step;
    int last_linear;
    double *offsets; /* of every wheel behind the first */
    double *before;  /* dynamic values at the start of the last step */
    double *after;   /* and at its end, while it may still be refused; then of trials */
    double *forces, *differences; /* of a trial, and of a group of outputs */
    double *q, *v;                /* coordinates of the suspension and their rates */
} rc_masses;

/* Where the dynamic values are. Displacement, velocity and force of every wheel are those when the
 * forces were known last, `passed` seconds ago; `slope` is that of the forces before. Behind them,
 * for the suspended vehicle: the coordinates behind those of the wheels, and their rates, at that
 * time; then all of them at the present; what displacements of the wheels count from, and their
 * changes of load. */
typedef struct {
    double *start, *time, *passed;
    double *displacement, *velocity, *force, *slope;
    double *above, *above_rate, *ahead, *ahead_rate;
    double *origin, *load_change;
} rc_masses_state;

static inline rc_masses_state rc_masses_view(const rc_masses *own, double *values)
{
    const size_t n = own->wheels, count = own->suspension.coordinates;
    double *wheels = values + 3, *above = wheels + 4 * n, *ahead = above + 2 * (count - n);
    return (rc_masses_state){values, values + 1, values + 2, wheels, wheels + n, wheels + 2 * n,
                             wheels + 3 * n, above, above + count - n, ahead, ahead + count,
                             ahead + 2 * count, ahead + 2 * count + n};
}

/* Life of the own part of a model. */
rc_status rc_open_masses(rc_model *model);
rc_status rc_prepare_masses(rc_model *model);
void rc_release_masses(rc_model *model);

/* Refuses inputs that are no numbers, even where they matter at the start only. */
rc_status rc_check_masses(rc_model *model, rc_status otherwise);

/* Static equilibrium; see rc_class. */
rc_status rc_start_masses(rc_model *model);

/* Puts the suspended vehicle in equilibrium on wheels that are held at given displacements, and
 * lets bodies move as wheels of the given velocities would; 0 if it finds none. */
int rc_settle_masses(const rc_masses *own, const rc_masses_state *at, const double *displacement,
                     const double *velocity);

/* Moves the suspended vehicle over a step, or on to where forces jump to; in place. */
void rc_move_suspended(const rc_masses *own, const rc_masses_state *at, const double *forces,
                       double step, int linear);
void rc_jump_suspended(const rc_masses *own, const rc_masses_state *at, const double *forces);

/* Derivative of the last step of the suspended vehicle, by central differences. */
void rc_derive_suspended(rc_model *model, const double *seed, double *change);

#endif
