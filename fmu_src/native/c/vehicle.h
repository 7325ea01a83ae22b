/* The vehicle: wheels that roll along a moving rail, each in Hertzian contact with it; twin of
 * vehicle_fmu/vehicle_model.py. */
#ifndef RC_VEHICLE_H
#define RC_VEHICLE_H

#include "instance.h"
#include "motion.h"
#include "surfaces.h"
#include "wheel.h"

/* Groups of variables, in the order of the declaration. */
enum {
    SPEED, SPEED_TABLE,
    WHEEL_MASS, STATIC_WHEEL_LOAD, AXLE_BASE, WHEEL_RADIUS, HERTZ_COEFFICIENT, INITIAL_POSITION,
    SUBSTEP,
    SURFACE,
    RAIL_DISPLACEMENT = SURFACE + RC_SURFACE_PARAMETER_COUNT,
    POSITION, CONTACT_FORCE, DISPLACEMENT, VELOCITY, GAP, IN_CONTACT,
    LINEAR_INPUTS
};

typedef struct {
    size_t wheels;
    rc_motion motion;
    rc_surfaces surfaces;
    rc_wheel wheel;
    double axle_base, initial_position, substep;
    int linear; /* of the last step */
    double *before, *after; /* dynamic values around the last step */
    double last_step;
} rc_vehicle;

/* Where the dynamic values are: the way of the state through time, then one for every wheel. */
typedef struct {
    double *start, *time, *displacement, *velocity, *rail;
} rc_vehicle_state;

static inline rc_vehicle_state rc_vehicle_view(const rc_vehicle *own, double *values)
{
    double *wheels = values + 2;
    return (rc_vehicle_state){values, values + 1, wheels, wheels + own->wheels,
                              wheels + 2 * own->wheels};
}

static inline size_t rc_vehicle_count(const rc_vehicle *own)
{
    return 2 + 3 * own->wheels;
}

/* Life of the vehicle's own part of a model. */
rc_status rc_open_vehicle(rc_model *model);
rc_status rc_prepare_vehicle(rc_model *model);
void rc_release_vehicle(rc_model *model);

/* Position of wheel 1 at a time [m]. */
double rc_leading_position(const rc_vehicle *own, double start, double time);

/* What tread and railhead lie lower under a wheel (from 0) when wheel 1 is at `leading` [m]. */
double rc_drop(const rc_vehicle *own, size_t wheel, double leading);

/* A step of one wheel. */
typedef struct {
    double start, time, step; /* of the simulation, of the step; its length [s] */
    double rail_start, rail_end; /* rail displacement, on a straight line */
    double rise_start, rise_end; /* what it changes by, for the derivative */
} rc_way;

/* Motion of a wheel at the end of the step; also its derivative where `change` is not NULL. */
rc_wheel_motion rc_roll_wheel(const rc_vehicle *own, size_t wheel, const rc_way *over,
                              rc_wheel_motion motion, rc_wheel_motion *change);

#endif
