/* The track as a model: its variables, its start, its steps. */
#include "track_setup.h"
#include "window.h"

#include <math.h>
#include <string.h>

enum {
    POSITION = RC_TRACK_PARAMETER_COUNT,
    CONTACT_FORCE,
    FIRST_OUTPUT,
    LINEAR_INPUTS = FIRST_OUTPUT + RC_TRACK_OUTPUT_COUNT
};

static const rc_group_kind KINDS[] = {
    RC_TRACK_PARAMETERS,
    [POSITION] = {"wheel[#].position", RC_REAL, RC_INPUT, RC_WHEELS},
    [CONTACT_FORCE] = {"wheel[#].contact_force", RC_REAL, RC_INPUT, RC_WHEELS},
    RC_TRACK_OUTPUTS(FIRST_OUTPUT),
    [LINEAR_INPUTS] = {"linear_inputs", RC_BOOLEAN, RC_PARAMETER, RC_ONE},
};

#define MOST_PARTS 1e5 /* of a step; less than a second of work */

static rc_status open_track(rc_model *model)
{
    rc_track *track = model->own;
    const rc_status status = rc_open_track(model, track);
    model->dynamic_count = rc_count_state(&track->basis);
    return status;
}

static void release(rc_model *model)
{
    rc_release_track(model->own);
}

static rc_status prepare(rc_model *model)
{
    model->linear = *rc_values(model, LINEAR_INPUTS) != 0.0;
    return rc_prepare_track(model, model->own);
}

/* Refuses wheels beyond the track and forces that are no numbers. */
static rc_status check_inputs(rc_model *model, rc_status otherwise)
{
    rc_track *track = model->own;
    const double *forces = rc_values(model, CONTACT_FORCE);
    for (size_t i = 0; i < track->basis.wheels; ++i)
        if (!(fabs(forces[i]) <= RC_MOST_FORCE))
            return rc_fail(model, otherwise,
                           "track: contact force %g N of wheel %zu must be a finite number of at "
                           "most %g N; look for the cause in the vehicle", forces[i], i + 1,
                           RC_MOST_FORCE);
    return rc_check_wheels(model, track, rc_values(model, POSITION), otherwise);
}

static rc_status start(rc_model *model)
{
    rc_track *track = model->own;
    rc_track_state state = rc_view_state(&track->basis, model->dynamic);
    if (check_inputs(model, RC_ERROR) != RC_OK)
        return RC_ERROR;
    return rc_start_track(model, track, &state, rc_values(model, POSITION),
                          rc_values(model, CONTACT_FORCE));
}

double rc_count_parts(double step)
{
    return fmax(1.0, ceil(step / RC_LONGEST_STEP - 1e-9));
}

rc_advance rc_advance_track(rc_track *track, double *dynamic, double step,
                            const double *positions, const double *forces)
{
    const rc_basis *basis = &track->basis;
    const size_t size = rc_count_state(basis) * sizeof(double);
    const double parts = rc_count_parts(step);
    rc_track_state state = rc_view_state(basis, dynamic);
    const int kept = parts > 1.0 || track->endless;
    if (kept)
        memcpy(track->before, dynamic, size);
    const rc_track_state from = rc_view_state(basis, track->before);
    for (double part = 1.0; part <= parts; ++part) {
        const int whole = !track->linear || part == parts;
        const double share = part / parts;
        for (size_t i = 0; i < basis->wheels; ++i) {
            track->position[i] =
                whole ? positions[i]
                      : from.position[i] + share * (positions[i] - from.position[i]);
            track->force[i] =
                whole ? forces[i] : from.force[i] + share * (forces[i] - from.force[i]);
        }
        if (track->endless && !rc_follow_wheels(track, &state, track->position)) {
            memcpy(dynamic, track->before, size);
            return RC_LOST;
        }
        rc_prepare_operator(track, dynamic, step / parts, track->linear, track->position);
        if (!rc_apply_operator(track, &state, track->force) || !rc_is_finite(basis, &state)) {
            memcpy(dynamic, kept ? track->before : track->operator_.start, size);
            return RC_NOT_CONVERGED;
        }
    }
    return RC_MADE;
}

static rc_status step_track(rc_model *model, double step, int linear)
{
    rc_track *track = model->own;
    if (check_inputs(model, RC_DISCARD) != RC_OK)
        return RC_DISCARD;
    if (step / RC_LONGEST_STEP > MOST_PARTS)
        return rc_fail(model, RC_DISCARD,
                       "track: a step of %g s is more than %g parts of %g s; use a shorter step",
                       step, MOST_PARTS, RC_LONGEST_STEP);
    track->linear = linear;
    const rc_advance advance = rc_advance_track(
        track, model->dynamic, step, rc_values(model, POSITION), rc_values(model, CONTACT_FORCE));
    if (advance == RC_LOST)
        return rc_refuse_lost(model, track, RC_DISCARD);
    if (advance != RC_MADE)
        return rc_fail(model, RC_DISCARD, "track: the state-dependent forces did not converge over "
                                          "a step of %.3g s; use a shorter step, or a longer one "
                                          "if it is next to nothing", step);
    track->last_step = step;
    return RC_OK;
}

static rc_status jump_track(rc_model *model)
{
    rc_track *track = model->own;
    rc_track_state state = rc_view_state(&track->basis, model->dynamic);
    if (check_inputs(model, RC_DISCARD) != RC_OK ||
        rc_locate_wheels(model, track, rc_values(model, POSITION), RC_DISCARD) != RC_OK)
        return RC_DISCARD;
    const size_t bytes = track->basis.wheels * sizeof(double);
    memcpy(state.position, rc_values(model, POSITION), bytes);
    memcpy(state.force, rc_values(model, CONTACT_FORCE), bytes);
    rc_load_track(track, &state);
    return RC_OK;
}

static void read_outputs(rc_model *model, size_t group, double *values)
{
    rc_track *track = model->own;
    const rc_track_state state = rc_view_state(&track->basis, model->dynamic);
    rc_observe(track, &state, (rc_observed)(group - FIRST_OUTPUT), values);
}

static const rc_class TRACK = {
    .name = "Track",
    .kinds = KINDS,
    .kind_count = sizeof KINDS / sizeof KINDS[0],
    .own_size = sizeof(rc_track),
    .open = open_track,
    .prepare = prepare,
    .start = start,
    .step = step_track,
    .jump = jump_track,
    .read = read_outputs,
    .derive = rc_derive_track,
    .release = release,
};

const rc_class *rc_library_class(void)
{
    return &TRACK;
}
