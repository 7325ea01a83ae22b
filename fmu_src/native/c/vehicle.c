/* The vehicle as a model: its variables, its start, its steps. */
#include "vehicle.h"

#include <math.h>
#include <string.h>

#include "contact.h"
#include "dense.h"

#define INSTANT 1e-6      /* s, over which the rate of a surface is taken at the start */

static const rc_group_kind KINDS[] = {
    [SPEED] = {"speed", RC_REAL, RC_PARAMETER, RC_ONE},
    [SPEED_TABLE] = {"speed_table", RC_TEXT, RC_PARAMETER, RC_ONE},
    [WHEEL_MASS] = {"wheel_mass", RC_REAL, RC_PARAMETER, RC_ONE},
    [STATIC_WHEEL_LOAD] = {"static_wheel_load", RC_REAL, RC_PARAMETER, RC_ONE},
    [WHEEL_RADIUS] = {"wheel_radius", RC_REAL, RC_PARAMETER, RC_ONE},
    [HERTZ_COEFFICIENT] = {"hertz_coefficient", RC_REAL, RC_PARAMETER, RC_ONE},
    [INITIAL_POSITION] = {"initial_position", RC_REAL, RC_PARAMETER, RC_ONE},
    [SUBSTEP] = {"substep", RC_REAL, RC_PARAMETER, RC_ONE},
    [OFFSET] = {"wheel[#].offset", RC_REAL, RC_PARAMETER, RC_FOLLOWERS},
    RC_SUSPENSION_PARAMETERS(SUSPENSION),
    RC_SURFACE_PARAMETERS(SURFACE),
    [RAIL_DISPLACEMENT] = {"wheel[#].rail_displacement", RC_REAL, RC_INPUT, RC_WHEELS},
    [POSITION] = {"wheel[#].position", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [CONTACT_FORCE] = {"wheel[#].contact_force", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [DISPLACEMENT] = {"wheel[#].displacement", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [VELOCITY] = {"wheel[#].velocity", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [GAP] = {"wheel[#].gap", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [IN_CONTACT] = {"wheel[#].in_contact", RC_BOOLEAN, RC_OUTPUT, RC_WHEELS},
    RC_BODY_OUTPUTS(BODIES),
    [LINEAR_INPUTS] = {"linear_inputs", RC_BOOLEAN, RC_PARAMETER, RC_ONE},
};

static rc_status check_rail(rc_model *model, rc_status otherwise)
{
    const double *rail = rc_values(model, RAIL_DISPLACEMENT);
    for (size_t i = 0; i < model->dimensions[RC_WHEELS]; ++i)
        if (!isfinite(rail[i]))
            return rc_fail(model, otherwise, "the rail displacement under wheel %zu is %g m; it "
                                             "must be a finite number", i + 1, rail[i]);
    return RC_OK;
}

static rc_status start_vehicle(rc_model *model)
{
    const rc_vehicle *own = model->own;
    const rc_vehicle_state at = rc_vehicle_view(own, model->dynamic);
    const double *rail = rc_values(model, RAIL_DISPLACEMENT), time = model->head->time;
    if (check_rail(model, RC_ERROR) != RC_OK)
        return RC_ERROR;
    const double delta = rc_hertz_compression(own->wheel.load, own->wheel.coefficient);
    const double leading = rc_leading_position(own, time, time);
    memset(model->dynamic, 0, model->dynamic_count * sizeof(double));
    *at.start = *at.time = time;
    for (size_t i = 0; i < own->wheels; ++i) {
        own->level[i] = rail[i] + rc_drop(own, i, leading);
        at.displacement[i] = own->level[i] + delta;
        at.velocity[i] = rc_rate(own, i, time, INSTANT);
        at.rail[i] = rail[i];
    }
    if (own->suspension.coupled && !rc_settle_vehicle(own, &at))
        return rc_fail(model, RC_ERROR,
                       "the vehicle finds no static equilibrium on wheels displaced by up to %g m "
                       "at the start; begin on a more even rail",
                       rc_largest(own->q, own->wheels));
    return RC_OK;
}

static void roll_wheels(const rc_vehicle *own, const rc_vehicle_state *from,
                        const rc_vehicle_state *to, const double *rail, double time, double step)
{
    for (size_t i = 0; i < own->wheels; ++i) {
        const rc_way over = {.start = *from->start, .time = time, .step = step,
                             .rail_start = own->linear ? from->rail[i] : rail[i],
                             .rail_end = rail[i]};
        const rc_wheel_motion motion = rc_roll_wheel(
            own, i, &over, (rc_wheel_motion){from->displacement[i], from->velocity[i]}, NULL);
        to->displacement[i] = motion.displacement;
        to->velocity[i] = motion.velocity;
        to->rail[i] = rail[i];
    }
    memset(to->origin, 0, sizeof(double) * (2 * own->suspension.coordinates - own->wheels));
}

static rc_status check_motion(rc_model *model, const rc_vehicle_state *to, const double *rail)
{
    const rc_vehicle *own = model->own;
    for (size_t i = 0; i < own->wheels; ++i)
        if (!(isfinite(to->displacement[i]) && isfinite(to->velocity[i])))
            return rc_fail(model, RC_DISCARD,
                           "the rail displacement of %g m under wheel %zu drives the wheel to %g m "
                           "at %g m/s; give a smaller one or a shorter step", rail[i], i + 1,
                           to->displacement[i], to->velocity[i]);
    for (size_t c = 0; c < 2 * (own->suspension.coordinates - own->wheels); ++c)
        if (own->suspension.coupled && !isfinite(to->above[c]))
            return rc_fail(model, RC_DISCARD,
                           "the rail displacements drive the bodies above the wheels out of the "
                           "range of numbers; give smaller ones or a shorter step");
    return RC_OK;
}

static rc_status step_vehicle(rc_model *model, double step, int linear)
{
    rc_vehicle *own = model->own;
    const size_t bytes = rc_vehicle_count(own) * sizeof(double);
    const rc_vehicle_state from = rc_vehicle_view(own, model->dynamic);
    const rc_vehicle_state to = rc_vehicle_view(own, own->after);
    const double *rail = rc_values(model, RAIL_DISPLACEMENT);
    if (check_rail(model, RC_DISCARD) != RC_OK)
        return RC_DISCARD;
    if (rc_check_substeps(model, step, own->substep) != RC_OK)
        return RC_DISCARD;
    const double leading = rc_leading_position(own, *from.start, model->head->time + step);
    if (!isfinite(leading))
        return rc_fail(model, RC_DISCARD, "wheel 1 would be at %g m at %g s; use a lower speed or a "
                                          "shorter step", leading, model->head->time + step);
    own->linear = linear;
    if (own->suspension.coupled)
        rc_roll_suspended(own, model->dynamic, own->after, rail, model->head->time, step);
    else
        roll_wheels(own, &from, &to, rail, model->head->time, step);
    if (check_motion(model, &to, rail) != RC_OK)
        return RC_DISCARD;
    *to.start = *from.start;
    *from.time = model->head->time; /* the host's, which need not be a sum of steps */
    *to.time = *from.time + step;
    memcpy(own->before, model->dynamic, bytes);
    memcpy(model->dynamic, own->after, bytes);
    own->last_step = step;
    return RC_OK;
}

static rc_status jump_vehicle(rc_model *model)
{
    const rc_vehicle *own = model->own;
    if (check_rail(model, RC_DISCARD) != RC_OK)
        return RC_DISCARD;
    memcpy(rc_vehicle_view(own, model->dynamic).rail, rc_values(model, RAIL_DISPLACEMENT),
           own->wheels * sizeof(double));
    return RC_OK;
}

static void read_vehicle(rc_model *model, size_t group, double *values)
{
    rc_read_vehicle(model->own, model->dynamic, group, values);
}

static const rc_class VEHICLE = {
    .name = "Vehicle",
    .kinds = KINDS,
    .kind_count = sizeof KINDS / sizeof KINDS[0],
    .own_size = sizeof(rc_vehicle),
    .open = rc_open_vehicle,
    .prepare = rc_prepare_vehicle,
    .start = start_vehicle,
    .step = step_vehicle,
    .jump = jump_vehicle,
    .read = read_vehicle,
    .derive = rc_derive_vehicle,
    .release = rc_release_vehicle,
};

const rc_class *rc_library_class(void)
{
    return &VEHICLE;
}
