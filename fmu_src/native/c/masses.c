/* Rigid wheel masses under their loads, pressed up by given contact forces; twin of
 * vehicle_fmu/masses.py. */
#include "masses.h"

#include <math.h>
#include <string.h>

#include "dense.h"

static const rc_group_kind KINDS[] = {
    [SPEED] = {"speed", RC_REAL, RC_PARAMETER, RC_ONE},
    [SPEED_TABLE] = {"speed_table", RC_TEXT, RC_PARAMETER, RC_ONE},
    [WHEEL_MASS] = {"wheel_mass", RC_REAL, RC_PARAMETER, RC_ONE},
    [STATIC_WHEEL_LOAD] = {"static_wheel_load", RC_REAL, RC_PARAMETER, RC_ONE},
    [INITIAL_POSITION] = {"initial_position", RC_REAL, RC_PARAMETER, RC_ONE},
    [SUBSTEP] = {"substep", RC_REAL, RC_PARAMETER, RC_ONE},
    [OFFSET] = {"wheel[#].offset", RC_REAL, RC_PARAMETER, RC_FOLLOWERS},
    RC_SUSPENSION_PARAMETERS(SUSPENSION),
    [CONTACT_FORCE] = {"wheel[#].contact_force", RC_REAL, RC_INPUT, RC_WHEELS},
    [STATIC_DISPLACEMENT] = {"wheel[#].static_displacement", RC_REAL, RC_INPUT, RC_WHEELS},
    [STATIC_VELOCITY] = {"wheel[#].static_velocity", RC_REAL, RC_INPUT, RC_WHEELS},
    [MEAN_VELOCITY] = {"wheel[#].mean_velocity", RC_REAL, RC_INPUT, RC_WHEELS},
    [POSITION] = {"wheel[#].position", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [DISPLACEMENT] = {"wheel[#].displacement", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [VELOCITY] = {"wheel[#].velocity", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [LOAD_CHANGE] = {"wheel[#].load_change", RC_REAL, RC_OUTPUT, RC_WHEELS},
    RC_BODY_OUTPUTS(BODIES),
    [LINEAR_INPUTS] = {"linear_inputs", RC_BOOLEAN, RC_PARAMETER, RC_ONE},
};

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
static motion moved(const rc_masses *own, const rc_masses_state *at, size_t wheel, double duration,
                    double slope)
{
    return accelerated((motion){at->displacement[wheel], at->velocity[wheel]}, duration,
                       (own->load - at->force[wheel]) / own->mass, -slope / own->mass);
}

/* Takes over the values in `after`, unless a wheel is driven out of the range of numbers. */
static rc_status accept(rc_model *model)
{
    const rc_masses *own = model->own;
    const rc_masses_state at = rc_masses_view(own, own->after);
    const double *forces = rc_values(model, CONTACT_FORCE);
    const double leading =
        own->initial_position + rc_distance(&own->motion, *at.start, *at.time);
    if (!isfinite(leading))
        return rc_fail(model, RC_DISCARD, "wheel 1 would be at %g m at %g s; use a lower speed or a "
                                          "shorter step", leading, *at.time);
    if (own->suspension.coupled) {
        const double largest = rc_largest(own->after + 3, model->dynamic_count - 3);
        if (!isfinite(largest))
            return rc_fail(model, RC_DISCARD,
                           "the contact forces, %g N on wheel 1, drive the vehicle out of the range "
                           "of numbers; give smaller ones or a step of another size", forces[0]);
    }
    for (size_t i = 0; i < own->wheels && !own->suspension.coupled; ++i) {
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
static void follow(const rc_masses *own, const rc_masses_state *at, double duration, const double *forces)
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
static void settle(const rc_masses *own, const rc_masses_state *at)
{
    for (size_t i = 0; i < own->wheels; ++i) {
        const motion now = moved(own, at, i, *at->passed, at->slope[i]);
        at->displacement[i] = now.displacement;
        at->velocity[i] = now.velocity;
        at->force[i] += *at->passed * at->slope[i];
    }
}

/* A copy of the dynamic values, to be accepted when it has moved. */
static rc_masses_state copy(const rc_model *model)
{
    const rc_masses *own = model->own;
    memcpy(own->after, model->dynamic, model->dynamic_count * sizeof(double));
    return rc_masses_view(own, own->after);
}

static rc_status step_masses(rc_model *model, double step, int linear)
{
    rc_masses *own = model->own;
    if (rc_check_masses(model, RC_DISCARD) != RC_OK ||
        (own->suspension.coupled && rc_check_substeps(model, step, own->substep) != RC_OK))
        return RC_DISCARD;
    memcpy(own->before, model->dynamic, model->dynamic_count * sizeof(double));
    const rc_masses_state at = copy(model);
    own->last_step = step;
    own->last_linear = linear;
    own->last_line = linear ? step : *at.passed;
    own->last_ahead = linear ? 0.0 : step;
    if (own->suspension.coupled) {
        rc_move_suspended(own, &at, rc_values(model, CONTACT_FORCE), step, linear);
    } else {
        if (linear && *at.passed > 0.0)
            settle(own, &at);
        follow(own, &at, own->last_line, rc_values(model, CONTACT_FORCE));
    }
    *at.time = model->head->time + step; /* the host's, which need not be a sum of steps */
    *at.passed = own->last_ahead;
    return accept(model);
}

static rc_status jump(rc_model *model)
{
    const rc_masses *own = model->own;
    if (rc_check_masses(model, RC_DISCARD) != RC_OK)
        return RC_DISCARD;
    const rc_masses_state at = copy(model);
    if (own->suspension.coupled)
        rc_jump_suspended(own, &at, rc_values(model, CONTACT_FORCE));
    else
        follow(own, &at, *at.passed, rc_values(model, CONTACT_FORCE));
    *at.passed = 0.0;
    return accept(model);
}

static void read_outputs(rc_model *model, size_t group, double *values)
{
    const rc_masses *own = model->own;
    const rc_masses_state at = rc_masses_view(own, model->dynamic);
    if (group >= BODIES) {
        rc_read_bodies(&own->suspension, at.ahead, at.ahead_rate, group - BODIES, values);
        return;
    }
    if (group == POSITION) {
        const double way = rc_distance(&own->motion, *at.start, *at.time);
        for (size_t i = 0; i < own->wheels; ++i)
            values[i] = own->initial_position + way - own->offsets[i];
        return;
    }
    if (group == LOAD_CHANGE) {
        memcpy(values, at.load_change, own->wheels * sizeof(double));
        return;
    }
    for (size_t i = 0; i < own->wheels; ++i) {
        const motion now = own->suspension.coupled
                               ? (motion){at.ahead[i] - at.origin[i], at.ahead_rate[i]}
                               : moved(own, &at, i, *at.passed, at.slope[i]);
        values[i] = group == DISPLACEMENT ? now.displacement : now.velocity;
    }
}

/* The motion of rigid masses is linear in the forces. */
static rc_status derive(rc_model *model, const double *seed, double *change)
{
    const rc_masses *own = model->own;
    const double line = own->last_line;
    if (own->suspension.coupled) {
        rc_derive_suspended(model, seed, change);
        return RC_OK;
    }
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
    .open = rc_open_masses,
    .prepare = rc_prepare_masses,
    .start = rc_start_masses,
    .step = step_masses,
    .jump = jump,
    .read = read_outputs,
    .derive = derive,
    .release = rc_release_masses,
};

const rc_class *rc_library_class(void)
{
    return &MASSES;
}
