/* Rigid wheel masses under their loads, pressed up by given contact forces; twin of
 * vehicle_fmu/masses.py. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"
#include "motion.h"

enum {
    SPEED, SPEED_TABLE,
    WHEEL_MASS, STATIC_WHEEL_LOAD, INITIAL_POSITION,
    OFFSET,
    CONTACT_FORCE,
    POSITION, DISPLACEMENT, VELOCITY,
    LINEAR_INPUTS
};

static const rc_group_kind KINDS[] = {
    [SPEED] = {"speed", RC_REAL, RC_PARAMETER, RC_ONE},
    [SPEED_TABLE] = {"speed_table", RC_TEXT, RC_PARAMETER, RC_ONE},
    [WHEEL_MASS] = {"wheel_mass", RC_REAL, RC_PARAMETER, RC_ONE},
    [STATIC_WHEEL_LOAD] = {"static_wheel_load", RC_REAL, RC_PARAMETER, RC_ONE},
    [INITIAL_POSITION] = {"initial_position", RC_REAL, RC_PARAMETER, RC_ONE},
    [OFFSET] = {"wheel[#].offset", RC_REAL, RC_PARAMETER, RC_FOLLOWERS},
    [CONTACT_FORCE] = {"wheel[#].contact_force", RC_REAL, RC_INPUT, RC_WHEELS},
    [POSITION] = {"wheel[#].position", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [DISPLACEMENT] = {"wheel[#].displacement", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [VELOCITY] = {"wheel[#].velocity", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [LINEAR_INPUTS] = {"linear_inputs", RC_BOOLEAN, RC_PARAMETER, RC_ONE},
};

typedef struct {
    size_t wheels;
    rc_motion motion;
    double mass, load, initial_position;
    double last_line, last_ahead; /* s; over which the last forces came to be known, and beyond */
    double *after; /* dynamic values at the end of a step that may still be refused */
} rc_masses;

/* Where the dynamic values are. Displacement, velocity and force of every wheel are those when the
 * forces were known last, `passed` seconds ago; `slope` is that of the forces before. */
typedef struct {
    double *start, *time, *passed;
    double *displacement, *velocity, *force, *slope;
} view;

static view look(const rc_masses *own, double *values)
{
    double *wheels = values + 3;
    return (view){values, values + 1, values + 2, wheels, wheels + own->wheels,
                  wheels + 2 * own->wheels, wheels + 3 * own->wheels};
}

static rc_status open_masses(rc_model *model)
{
    rc_masses *own = model->own;
    if (rc_read_wheels(model) != RC_OK)
        return RC_ERROR;
    own->wheels = model->dimensions[RC_WHEELS];
    model->dynamic_count = 3 + 4 * own->wheels;
    own->after = calloc(model->dynamic_count, sizeof(double));
    return own->after != NULL
               ? RC_OK
               : rc_fail(model, RC_ERROR, "there is not enough memory for the masses");
}

static void release(rc_model *model)
{
    rc_masses *own = model->own;
    rc_free_motion(&own->motion);
    free(own->after);
}

static rc_status check_parameters(rc_model *model)
{
    if (rc_require_positive(model, WHEEL_MASS, "kg", "give half the unsprung mass of a wheelset") !=
            RC_OK ||
        rc_require_positive(model, STATIC_WHEEL_LOAD, "N", "give half the axle load as a force") !=
            RC_OK ||
        rc_require_finite(model, INITIAL_POSITION, "m", "give the start of wheel 1") != RC_OK)
        return RC_ERROR;
    const double *offsets = rc_values(model, OFFSET);
    for (size_t i = 0; i + 1 < model->dimensions[RC_WHEELS]; ++i)
        if (!isfinite(offsets[i]))
            return rc_fail(model, RC_ERROR, "offset of wheel %zu is %g m; it must be a finite "
                                            "number: give its way behind wheel 1", i + 2,
                           offsets[i]);
    return RC_OK;
}

static rc_status prepare(rc_model *model)
{
    rc_masses *own = model->own;
    rc_free_motion(&own->motion);
    if (check_parameters(model) != RC_OK)
        return RC_ERROR;
    own->mass = *rc_values(model, WHEEL_MASS);
    own->load = *rc_values(model, STATIC_WHEEL_LOAD);
    own->initial_position = *rc_values(model, INITIAL_POSITION);
    model->linear = *rc_values(model, LINEAR_INPUTS) != 0.0;
    if (!rc_make_motion(&own->motion, *rc_values(model, SPEED), rc_text(model, SPEED_TABLE),
                        model->message, RC_MESSAGE_SIZE)) {
        rc_free_motion(&own->motion);
        return RC_ERROR;
    }
    return RC_OK;
}

static rc_status check_forces(rc_model *model, rc_status otherwise)
{
    const double *forces = rc_values(model, CONTACT_FORCE);
    for (size_t i = 0; i < model->dimensions[RC_WHEELS]; ++i)
        if (!isfinite(forces[i]))
            return rc_fail(model, otherwise, "the contact force of wheel %zu is %g N; it must be a "
                                             "finite number", i + 1, forces[i]);
    return RC_OK;
}

static rc_status start(rc_model *model)
{
    const rc_masses *own = model->own;
    const view at = look(own, model->dynamic);
    const double *forces = rc_values(model, CONTACT_FORCE);
    if (check_forces(model, RC_ERROR) != RC_OK)
        return RC_ERROR;
    *at.start = *at.time = model->head->time;
    *at.passed = 0.0;
    for (size_t i = 0; i < own->wheels; ++i) {
        at.displacement[i] = at.velocity[i] = at.slope[i] = 0.0;
        at.force[i] = forces[i];
    }
    return RC_OK;
}

typedef struct {
    double displacement, velocity;
} motion;

/* After a time of constant jerk. */
static motion accelerated(motion from, double duration, double acceleration, double jerk)
{
    const double v = from.velocity;
    return (motion){
        from.displacement +
            duration * (v + duration * (0.5 * acceleration + duration / 6.0 * jerk)),
        v + duration * (acceleration + 0.5 * duration * jerk)};
}

/* A wheel after a time in which its force changes at the given rate. */
static motion moved(const rc_masses *own, const view *at, size_t wheel, double duration,
                    double slope)
{
    return accelerated((motion){at->displacement[wheel], at->velocity[wheel]}, duration,
                       (own->load - at->force[wheel]) / own->mass, -slope / own->mass);
}

/* Takes over the values in `after`, unless a wheel is driven out of the range of numbers. */
static rc_status accept(rc_model *model)
{
    const rc_masses *own = model->own;
    const view at = look(own, own->after);
    const double *forces = rc_values(model, CONTACT_FORCE);
    const double leading =
        own->initial_position + rc_distance(&own->motion, *at.start, *at.time);
    if (!isfinite(leading))
        return rc_fail(model, RC_DISCARD, "wheel 1 would be at %g m at %g s; use a lower speed or a "
                                          "shorter step", leading, *at.time);
    for (size_t i = 0; i < own->wheels; ++i) {
        const motion now = moved(own, &at, i, *at.passed, at.slope[i]);
        if (!(isfinite(now.displacement) && isfinite(now.velocity) && isfinite(at.slope[i])))
            return rc_fail(model, RC_DISCARD,
                           "the contact force of %g N on wheel %zu drives the wheel to %g m at "
                           "%g m/s; give a smaller one or a step of another size", forces[i],
                           i + 1, now.displacement, now.velocity);
    }
    memcpy(model->dynamic, own->after, model->dynamic_count * sizeof(double));
    return RC_OK;
}

/* Moves every wheel to where its force is known to have become the given one. */
static void follow(const rc_masses *own, const view *at, double duration, const double *forces)
{
    for (size_t i = 0; i < own->wheels; ++i) {
        if (duration > 0.0) {
            const double slope = (forces[i] - at->force[i]) / duration;
            const motion now = moved(own, at, i, duration, slope);
            at->displacement[i] = now.displacement;
            at->velocity[i] = now.velocity;
            at->slope[i] = slope;
        }
        at->force[i] = forces[i];
    }
}

/* The same where the continued line has come true. */
static void settle(const rc_masses *own, const view *at)
{
    for (size_t i = 0; i < own->wheels; ++i) {
        const motion now = moved(own, at, i, *at->passed, at->slope[i]);
        at->displacement[i] = now.displacement;
        at->velocity[i] = now.velocity;
        at->force[i] += *at->passed * at->slope[i];
    }
}

/* A copy of the dynamic values, to be accepted when it has moved. */
static view copy(const rc_model *model)
{
    const rc_masses *own = model->own;
    memcpy(own->after, model->dynamic, model->dynamic_count * sizeof(double));
    return look(own, own->after);
}

static rc_status step_masses(rc_model *model, double step, int linear)
{
    rc_masses *own = model->own;
    if (check_forces(model, RC_DISCARD) != RC_OK)
        return RC_DISCARD;
    const view at = copy(model);
    if (linear && *at.passed > 0.0)
        settle(own, &at);
    own->last_line = linear ? step : *at.passed;
    own->last_ahead = linear ? 0.0 : step;
    follow(own, &at, own->last_line, rc_values(model, CONTACT_FORCE));
    *at.time = model->head->time + step; /* the host's, which need not be a sum of steps */
    *at.passed = own->last_ahead;
    return accept(model);
}

static rc_status jump(rc_model *model)
{
    const rc_masses *own = model->own;
    if (check_forces(model, RC_DISCARD) != RC_OK)
        return RC_DISCARD;
    const view at = copy(model);
    follow(own, &at, *at.passed, rc_values(model, CONTACT_FORCE));
    *at.passed = 0.0;
    return accept(model);
}

static void read_outputs(rc_model *model, size_t group, double *values)
{
    const rc_masses *own = model->own;
    const view at = look(own, model->dynamic);
    const double way = rc_distance(&own->motion, *at.start, *at.time);
    for (size_t i = 0; i < own->wheels; ++i) {
        const double offset = i == 0 ? 0.0 : rc_values(model, OFFSET)[i - 1];
        const motion now = moved(own, &at, i, *at.passed, at.slope[i]);
        values[i] = group == POSITION       ? own->initial_position + way - offset
                    : group == DISPLACEMENT ? now.displacement
                                            : now.velocity;
    }
}

/* The motion is linear in the forces. */
static rc_status derive(rc_model *model, const double *seed, double *change)
{
    const rc_masses *own = model->own;
    const double line = own->last_line;
    for (size_t i = 0; i < own->wheels; ++i) {
        const double push = -seed[i] / own->mass, jerk = line > 0.0 ? push / line : 0.0;
        const motion known = accelerated((motion){0.0, 0.0}, line, 0.0, jerk);
        const motion by = accelerated(known, own->last_ahead, push, jerk);
        change[model->slots[DISPLACEMENT] + i] = by.displacement;
        change[model->slots[VELOCITY] + i] = by.velocity;
    }
    return RC_OK;
}

static const rc_class MASSES = {
    .name = "Masses",
    .kinds = KINDS,
    .kind_count = sizeof KINDS / sizeof KINDS[0],
    .own_size = sizeof(rc_masses),
    .open = open_masses,
    .prepare = prepare,
    .start = start,
    .step = step_masses,
    .jump = jump,
    .read = read_outputs,
    .derive = derive,
    .release = release,
};

const rc_class *rc_library_class(void)
{
    return &MASSES;
}
