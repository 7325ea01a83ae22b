/* The vehicle: wheels that roll along a moving rail, each in Hertzian contact with it; twin of
 * vehicle_fmu/vehicle_model.py. */
#ifndef RC_VEHICLE_H
#define RC_VEHICLE_H

#include "instance.h"
#include "motion.h"
#include "surfaces.h"
#include "suspension.h"
#include "wheel.h"

/* Groups of variables, in the order of the declaration. */
enum {
    SPEED, SPEED_TABLE,
    WHEEL_MASS, STATIC_WHEEL_LOAD, WHEEL_RADIUS, HERTZ_COEFFICIENT, INITIAL_POSITION, SUBSTEP,
    OFFSET,
    SUSPENSION,
    SURFACE = SUSPENSION + RC_SUSPENSION_PARAMETER_COUNT,
    RAIL_DISPLACEMENT = SURFACE + RC_SURFACE_PARAMETER_COUNT,
    POSITION, CONTACT_FORCE, DISPLACEMENT, VELOCITY, GAP, IN_CONTACT,
    BODIES,
    LINEAR_INPUTS = BODIES + RC_BODY_OUTPUT_COUNT
};

typedef struct {
    size_t wheels;
    rc_motion motion;
    rc_surfaces surfaces;
    rc_wheel wheel;
    rc_suspension suspension;
    double *offsets; /* of every wheel behind the first */
    double initial_position, substep;
    int linear; /* of the last step */
    double *before, *after; /* dynamic values around the last step */
    double *trial;          /* those of a step with other inputs, for the derivative */
    double *rail, *level;   /* of every wheel: another input, and the surface under it */
    double *q, *v;          /* coordinates of the suspension and their rates */
    double *differences;    /* of a group of outputs */
    double last_step;
} rc_vehicle;

/* Where the dynamic values are: the way of the state through time, then one for every wheel; behind
 * them, for the suspended vehicle, what the wheels' coordinates count from, and the coordinates
 * behind those of the wheels, and their rates. */
typedef struct {
    double *start, *time, *displacement, *velocity, *rail, *origin, *above, *above_rate;
} rc_vehicle_state;

static inline rc_vehicle_state rc_vehicle_view(const rc_vehicle *own, double *values)
{
    const size_t n = own->wheels;
    double *wheels = values + 2, *above = wheels + 4 * n;
    return (rc_vehicle_state){values, values + 1, wheels, wheels + n, wheels + 2 * n,
                              wheels + 3 * n, above, above + own->suspension.coordinates - n};
}

static inline size_t rc_vehicle_count(const rc_vehicle *own)
{
    return 2 + 2 * (own->wheels + own->suspension.coordinates);
}

/* Life of the vehicle's own part of a model. */
rc_status rc_open_vehicle(rc_model *model);
rc_status rc_prepare_vehicle(rc_model *model);
void rc_release_vehicle(rc_model *model);

/* Position of wheel 1 at a time [m]. */
double rc_leading_position(const rc_vehicle *own, double start, double time);

/* What tread and railhead lie lower under a wheel (from 0) when wheel 1 is at `leading` [m]. */
double rc_drop(const rc_vehicle *own, size_t wheel, double leading);

/* How fast that grows at the start time: the mean over a span, half of it before and half after. */
double rc_rate(const rc_vehicle *own, size_t wheel, double start, double span);

/* A step of one wheel. */
typedef struct {
    double start, time, step; /* of the simulation, of the step; its length [s] */
    double rail_start, rail_end; /* rail displacement, on a straight line */
    double rise_start, rise_end; /* what it changes by, for the derivative */
} rc_way;

/* Level of the surface under a wheel after k of so many half substeps. */
double rc_level(const rc_vehicle *own, size_t wheel, const rc_way *over, size_t k, size_t halves);

/* Motion of a wheel at the end of the step; also its derivative where `change` is not NULL. */
rc_wheel_motion rc_roll_wheel(const rc_vehicle *own, size_t wheel, const rc_way *over,
                              rc_wheel_motion motion, rc_wheel_motion *change);

/* Coordinates of the suspended vehicle and their rates, into q and v. */
void rc_take_coordinates(const rc_vehicle *own, const double *values, double *q, double *v);

/* Puts the suspended vehicle, whose wheels are on their levels under static load, in equilibrium;
 * 0 if it finds none. */
int rc_settle_vehicle(const rc_vehicle *own, const rc_vehicle_state *at);

/* Moves the suspended vehicle from one block of dynamic values to another, but for its time. */
void rc_roll_suspended(const rc_vehicle *own, double *from, double *to, const double *rail,
                       double time, double step);

/* Outputs of a group for a block of dynamic values. */
void rc_read_vehicle(const rc_vehicle *own, double *dynamic, size_t group, double *values);

/* Derivative of the last step; see rc_class. */
rc_status rc_derive_vehicle(rc_model *model, const double *seed, double *change);

#endif
