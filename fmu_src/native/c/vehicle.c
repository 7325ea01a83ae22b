/* The vehicle as a model: its variables, its start, its steps. */
#include "vehicle.h"

#include <math.h>
#include <string.h>

#include "contact.h"

#define MOST_SUBSTEPS 1e5 /* of a step; 2 s with the usual substep, the way of a whole passage */

static const rc_group_kind KINDS[] = {
    [SPEED] = {"speed", RC_REAL, RC_PARAMETER, RC_ONE},
    [SPEED_TABLE] = {"speed_table", RC_TEXT, RC_PARAMETER, RC_ONE},
    [WHEEL_MASS] = {"wheel_mass", RC_REAL, RC_PARAMETER, RC_ONE},
    [STATIC_WHEEL_LOAD] = {"static_wheel_load", RC_REAL, RC_PARAMETER, RC_ONE},
    [AXLE_BASE] = {"axle_base", RC_REAL, RC_PARAMETER, RC_ONE},
    [WHEEL_RADIUS] = {"wheel_radius", RC_REAL, RC_PARAMETER, RC_ONE},
    [HERTZ_COEFFICIENT] = {"hertz_coefficient", RC_REAL, RC_PARAMETER, RC_ONE},
    [INITIAL_POSITION] = {"initial_position", RC_REAL, RC_PARAMETER, RC_ONE},
    [SUBSTEP] = {"substep", RC_REAL, RC_PARAMETER, RC_ONE},
    RC_SURFACE_PARAMETERS(SURFACE),
    [RAIL_DISPLACEMENT] = {"wheel[#].rail_displacement", RC_REAL, RC_INPUT, RC_WHEELS},
    [POSITION] = {"wheel[#].position", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [CONTACT_FORCE] = {"wheel[#].contact_force", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [DISPLACEMENT] = {"wheel[#].displacement", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [VELOCITY] = {"wheel[#].velocity", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [GAP] = {"wheel[#].gap", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [IN_CONTACT] = {"wheel[#].in_contact", RC_BOOLEAN, RC_OUTPUT, RC_WHEELS},
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
    *at.start = *at.time = time;
    for (size_t i = 0; i < own->wheels; ++i) {
        at.displacement[i] = rail[i] + rc_drop(own, i, leading) + delta;
        at.velocity[i] = 0.0;
        at.rail[i] = rail[i];
    }
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
    if (step / own->substep > MOST_SUBSTEPS)
        return rc_fail(model, RC_DISCARD, "a step of %g s is more than %g substeps of %g s; use a "
                                          "shorter step", step, MOST_SUBSTEPS, own->substep);
    const double leading = rc_leading_position(own, *from.start, model->head->time + step);
    if (!isfinite(leading))
        return rc_fail(model, RC_DISCARD, "wheel 1 would be at %g m at %g s; use a lower speed or a "
                                          "shorter step", leading, model->head->time + step);
    own->linear = linear;
    for (size_t i = 0; i < own->wheels; ++i) {
        const rc_way over = {.start = *from.start, .time = model->head->time, .step = step,
                          .rail_start = own->linear ? from.rail[i] : rail[i],
                          .rail_end = rail[i]};
        const rc_wheel_motion motion = rc_roll_wheel(
            own, i, &over, (rc_wheel_motion){from.displacement[i], from.velocity[i]}, NULL);
        if (!(isfinite(motion.displacement) && isfinite(motion.velocity)))
            return rc_fail(model, RC_DISCARD,
                           "the rail displacement of %g m under wheel %zu drives the wheel to %g m "
                           "at %g m/s; give a smaller one or a shorter step", rail[i], i + 1,
                           motion.displacement, motion.velocity);
        to.displacement[i] = motion.displacement;
        to.velocity[i] = motion.velocity;
        to.rail[i] = rail[i];
    }
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

static double compression(const rc_vehicle *own, const rc_vehicle_state *at, size_t wheel)
{
    const double leading = rc_leading_position(own, *at->start, *at->time);
    return at->displacement[wheel] - (at->rail[wheel] + rc_drop(own, wheel, leading));
}

static void read_vehicle(rc_model *model, size_t group, double *values)
{
    const rc_vehicle *own = model->own;
    const rc_vehicle_state at = rc_vehicle_view(own, model->dynamic);
    for (size_t i = 0; i < own->wheels; ++i)
        switch (group) {
        case POSITION:
            values[i] = rc_leading_position(own, *at.start, *at.time) - (double)i * own->axle_base;
            break;
        case CONTACT_FORCE:
            values[i] = rc_hertz_force(compression(own, &at, i), own->wheel.coefficient);
            break;
        case DISPLACEMENT:
            values[i] = at.displacement[i];
            break;
        case VELOCITY:
            values[i] = at.velocity[i];
            break;
        case GAP:
            values[i] = -compression(own, &at, i);
            break;
        default: /* IN_CONTACT */
            values[i] = compression(own, &at, i) > 0.0 ? 1.0 : 0.0;
        }
}

static rc_status derive_vehicle(rc_model *model, const double *seed, double *change)
{
    const rc_vehicle *own = model->own;
    const rc_vehicle_state from = rc_vehicle_view(own, own->before);
    const rc_vehicle_state at = rc_vehicle_view(own, model->dynamic);
    for (size_t i = 0; i < own->wheels; ++i) {
        const rc_way over = {.start = *from.start, .time = *from.time, .step = own->last_step,
                          .rail_start = own->linear ? from.rail[i] : at.rail[i],
                          .rail_end = at.rail[i],
                          .rise_start = own->linear ? 0.0 : seed[i], .rise_end = seed[i]};
        rc_wheel_motion moved = {0.0, 0.0};
        (void)rc_roll_wheel(own, i, &over,
                            (rc_wheel_motion){from.displacement[i], from.velocity[i]}, &moved);
        const double delta = compression(own, &at, i), closer = moved.displacement - seed[i];
        change[model->slots[CONTACT_FORCE] + i] =
            rc_hertz_stiffness(delta, own->wheel.coefficient) * closer;
        change[model->slots[DISPLACEMENT] + i] = moved.displacement;
        change[model->slots[VELOCITY] + i] = moved.velocity;
        change[model->slots[GAP] + i] = -closer;
    }
    return RC_OK;
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
    .derive = derive_vehicle,
    .release = rc_release_vehicle,
};

const rc_class *rc_library_class(void)
{
    return &VEHICLE;
}
