/* The track with its contacts as a model: its variables, its start, its steps. */
#include "track_contact.h"

#include <math.h>
#include <string.h>

#include "contact.h"
#include "dense.h"
#include "track_setup.h"

static const rc_group_kind KINDS[] = {
    RC_TRACK_PARAMETERS,
    [STATIC_WHEEL_LOAD] = {"static_wheel_load", RC_REAL, RC_PARAMETER, RC_ONE},
    [WHEEL_RADIUS] = {"wheel_radius", RC_REAL, RC_PARAMETER, RC_ONE},
    [HERTZ_COEFFICIENT] = {"hertz_coefficient", RC_REAL, RC_PARAMETER, RC_ONE},
    RC_SURFACE_PARAMETERS(SURFACE),
    [POSITION] = {"wheel[#].position", RC_REAL, RC_INPUT, RC_WHEELS},
    [DISPLACEMENT] = {"wheel[#].displacement", RC_REAL, RC_INPUT, RC_WHEELS},
    [LOAD_CHANGE] = {"wheel[#].load_change", RC_REAL, RC_INPUT, RC_WHEELS},
    [INITIAL_VELOCITY] = {"wheel[#].velocity", RC_REAL, RC_INPUT, RC_WHEELS},
    [CONTACT_FORCE] = {"wheel[#].contact_force", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [CONTACT_FORCE_AHEAD] = {"wheel[#].contact_force_ahead", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [GAP] = {"wheel[#].gap", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [IN_CONTACT] = {"wheel[#].in_contact", RC_BOOLEAN, RC_OUTPUT, RC_WHEELS},
    [STATIC_DISPLACEMENT] = {"wheel[#].static_displacement", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [STATIC_VELOCITY] = {"wheel[#].static_velocity", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [MEAN_VELOCITY] = {"wheel[#].mean_velocity", RC_REAL, RC_OUTPUT, RC_WHEELS},
    RC_TRACK_OUTPUTS(TRACK_OUTPUT),
    [LINEAR_INPUTS] = {"linear_inputs", RC_BOOLEAN, RC_PARAMETER, RC_ONE},
};

#define MOST_PARTS 1e5          /* of a step; a second of work */
#define SMALL_MOVE 1e-5         /* m; of a position, to difference a step */
#define SMALL_DISPLACEMENT 1e-8 /* m; likewise of a displacement */

static rc_status open_contact(rc_model *model)
{
    rc_track_contact *own = model->own;
    const rc_status status = rc_open_track(model, &own->track);
    model->dynamic_count = rc_count_contact(&own->track.basis);
    return status;
}

static void release(rc_model *model)
{
    rc_track_contact *own = model->own;
    rc_release_track(&own->track);
    rc_release_contact(own);
    rc_free_surfaces(&own->surfaces);
}

static rc_status prepare(rc_model *model)
{
    rc_track_contact *own = model->own;
    own->static_load = *rc_values(model, STATIC_WHEEL_LOAD);
    own->coefficient = *rc_values(model, HERTZ_COEFFICIENT);
    model->linear = *rc_values(model, LINEAR_INPUTS) != 0.0;
    if (rc_prepare_track(model, &own->track) != RC_OK || rc_claim_contact(model, own) != RC_OK)
        return RC_ERROR;
    if (!(isfinite(own->static_load) && own->static_load >= 0.0))
        return rc_fail(model, RC_ERROR, "track: static_wheel_load = %g N must be a finite number, "
                                        "at least 0", own->static_load);
    if (rc_require_positive(model, WHEEL_RADIUS, "m", "give half the wheel diameter") != RC_OK ||
        rc_require_positive(model, HERTZ_COEFFICIENT, "N/m^1.5",
                            "about 9e10 for steel wheel and rail") != RC_OK)
        return RC_ERROR;
    return rc_make_surfaces(model, &own->surfaces, SURFACE, *rc_values(model, WHEEL_RADIUS),
                            own->track.basis.wheels);
}

/* Positions, then displacements. */
static const double *given_inputs(const rc_model *model)
{
    return rc_values(model, POSITION);
}

rc_status rc_check_contact(rc_model *model, rc_status otherwise)
{
    rc_track *track = &((rc_track_contact *)model->own)->track;
    const double *displacements = rc_values(model, DISPLACEMENT);
    for (size_t i = 0; i < track->basis.wheels; ++i)
        if (!isfinite(displacements[i]))
            return rc_fail(model, otherwise, "track: displacement %g m of wheel %zu must be a "
                                             "finite number; look for the cause in the vehicle",
                           displacements[i], i + 1);
    for (size_t i = 0; i < track->basis.wheels; ++i) {
        const double change = rc_values(model, LOAD_CHANGE)[i];
        const double velocity = rc_values(model, INITIAL_VELOCITY)[i];
        if (!(isfinite(change) && isfinite(velocity)))
            return rc_fail(model, otherwise,
                           "track: load change %g N and velocity %g m/s of wheel %zu must be finite "
                           "numbers; look for the cause in the vehicle", change, velocity, i + 1);
    }
    return rc_check_wheels(model, track, given_inputs(model), otherwise);
}

static rc_status step_contact(rc_model *model, double step, int linear)
{
    rc_track_contact *own = model->own;
    const size_t bytes = model->dynamic_count * sizeof(double);
    const rc_contact_state at = rc_view_contact(&own->track.basis, model->dynamic);
    if (rc_check_contact(model, RC_DISCARD) != RC_OK)
        return RC_DISCARD;
    if (step / RC_LONGEST_PART > MOST_PARTS)
        return rc_fail(model, RC_DISCARD,
                       "track: a step of %g s is more than %g parts of %g s; use a shorter step",
                       step, MOST_PARTS, RC_LONGEST_PART);
    if (!linear)
        rc_doubt_contact(own, &at, step, given_inputs(model), model->warning, RC_MESSAGE_SIZE);
    memcpy(own->given, given_inputs(model), 2 * own->track.basis.wheels * sizeof(double));
    memcpy(own->before, model->dynamic, bytes);
    const rc_advance advance = rc_advance_contact(own, model->dynamic, step, own->given, linear);
    if (advance != RC_MADE) {
        memcpy(model->dynamic, own->before, bytes);
        if (advance == RC_LOST)
            return rc_refuse_lost(model, &own->track, RC_DISCARD);
        return rc_fail(model, RC_DISCARD, "track: the contact forces did not converge over a step "
                                          "of %.3g s; use a shorter step", step);
    }
    own->last_step = step;
    own->linear = linear;
    return RC_OK;
}

static rc_status jump(rc_model *model)
{
    rc_track_contact *own = model->own;
    const rc_contact_state at = rc_view_contact(&own->track.basis, model->dynamic);
    if (rc_check_contact(model, RC_DISCARD) != RC_OK)
        return RC_DISCARD;
    rc_take_contact(own, &at, given_inputs(model));
    return RC_OK;
}

static void read_values(rc_track_contact *own, double *dynamic, size_t group, double *values)
{
    const rc_contact_state at = rc_view_contact(&own->track.basis, dynamic);
    const rc_track_state state = rc_view_state(&own->track.basis, dynamic);
    if (group >= TRACK_OUTPUT) {
        rc_observe(&own->track, &state, (rc_observed)(group - TRACK_OUTPUT), values);
        return;
    }
    for (size_t i = 0; i < own->track.basis.wheels; ++i)
        switch (group) {
        case CONTACT_FORCE:
            values[i] = state.force[i];
            break;
        case CONTACT_FORCE_AHEAD:
            values[i] = at.ahead[i];
            break;
        case GAP:
            values[i] = -at.compression[i];
            break;
        case IN_CONTACT:
            values[i] = at.compression[i] > 0.0 ? 1.0 : 0.0;
            break;
        case STATIC_VELOCITY:
            values[i] = at.velocity[i];
            break;
        case MEAN_VELOCITY:
            values[i] = at.mean_velocity[i];
            break;
        default: /* STATIC_DISPLACEMENT */
            values[i] = at.origin[i];
        }
}

static void read_outputs(rc_model *model, size_t group, double *values)
{
    read_values(model->own, model->dynamic, group, values);
}

/* Outputs after the last step, had its inputs been by `factor` times the seed further on. */
static rc_status repeat(rc_model *model, const double *seed, double factor, double *outputs)
{
    rc_track_contact *own = model->own;
    for (size_t k = 0; k < 2 * own->track.basis.wheels; ++k)
        own->moved[k] = own->given[k] + factor * seed[k];
    if (rc_check_wheels(model, &own->track, own->moved, RC_DISCARD) != RC_OK)
        return RC_DISCARD;
    memcpy(own->after, own->before, model->dynamic_count * sizeof(double));
    if (rc_advance_contact(own, own->after, own->last_step, own->moved, own->linear) != RC_MADE)
        return rc_fail(model, RC_DISCARD, "track: the last step has no derivative");
    for (size_t group = CONTACT_FORCE; group < LINEAR_INPUTS; ++group)
        read_values(own, own->after, group, outputs + model->slots[group]);
    return RC_OK;
}

static rc_status derive(rc_model *model, const double *seed, double *changes)
{
    const size_t wheels = model->dimensions[RC_WHEELS];
    const double size = fmax(rc_largest(seed, wheels) / SMALL_MOVE,
                             rc_largest(seed + wheels, wheels) / SMALL_DISPLACEMENT);
    if (!(size > 0.0))
        return RC_OK; /* the changes are zeros already */
    const double factor = 1.0 / size;
    memset(model->known, 0, model->kind->kind_count); /* the outputs' place is borrowed */
    if (repeat(model, seed, factor, changes) != RC_OK ||
        repeat(model, seed, -factor, model->outputs) != RC_OK)
        return RC_DISCARD;
    for (size_t k = 0; k < model->output_count; ++k)
        changes[k] = (changes[k] - model->outputs[k]) / (2.0 * factor);
    return RC_OK;
}

static const rc_class TRACK_CONTACT = {
    .name = "TrackContact",
    .kinds = KINDS,
    .kind_count = sizeof KINDS / sizeof KINDS[0],
    .own_size = sizeof(rc_track_contact),
    .open = open_contact,
    .prepare = prepare,
    .start = rc_start_contact,
    .step = step_contact,
    .jump = jump,
    .read = read_outputs,
    .derive = derive,
    .release = release,
};

const rc_class *rc_library_class(void)
{
    return &TRACK_CONTACT;
}
