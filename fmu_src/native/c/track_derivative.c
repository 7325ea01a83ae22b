/* What a change of the inputs at the end of the last step changes in the outputs of the track. */
#include <math.h>
#include <string.h>

#include "track_setup.h"

#define SMALL_MOVE 1e-5  /* m; of a position, to difference a step */
#define SMALL_FORCE 10.0 /* N; likewise of a contact force */

/* All outputs, one block after the other: they stand in the order of rc_observed. */
static void observe_all(rc_model *model, const rc_track_state *state, double *outputs)
{
    for (size_t g = 0, what = 0; g < model->kind->kind_count; ++g)
        if (model->groups[g].causality == RC_OUTPUT)
            rc_observe(model->own, state, (rc_observed)what++, outputs + model->slots[g]);
}

/* The derivative by the contact forces alone, of a step that was not divided. */
static rc_status differentiate(rc_model *model, const double *force_seed, double *changes)
{
    rc_track *track = model->own;
    rc_track_state end = rc_view_state(&track->basis, track->after);
    rc_track_state change = rc_view_state(&track->basis, track->change);
    const rc_track_state present = rc_view_state(&track->basis, model->dynamic);
    rc_prepare_operator(track, track->before, track->last_step, track->linear, present.position);
    if (!rc_apply_operator(track, &end, present.force) ||
        !rc_differentiate_operator(track, force_seed, &change))
        return rc_fail(model, RC_DISCARD, "track: the last step has no derivative");
    observe_all(model, &change, changes);
    changes[model->output_count - 1] = 0.0; /* the window, which forces do not move */
    return RC_OK;
}

/* Outputs after the last step, had its inputs been by `factor` times the seed further on. */
static rc_status repeat(rc_model *model, const double *seed, double factor, double *outputs)
{
    rc_track *track = model->own;
    const size_t wheels = track->basis.wheels;
    const rc_track_state present = rc_view_state(&track->basis, model->dynamic);
    for (size_t i = 0; i < wheels; ++i) {
        track->moved[i] = present.position[i] + factor * seed[i];
        track->pressed[i] = present.force[i] + factor * seed[wheels + i];
    }
    if (rc_check_wheels(model, track, track->moved, RC_DISCARD) != RC_OK)
        return RC_DISCARD;
    memcpy(track->after, track->before, rc_count_state(&track->basis) * sizeof(double));
    if (rc_advance_track(track, track->after, track->last_step, track->moved, track->pressed) !=
        RC_MADE)
        return rc_fail(model, RC_DISCARD, "track: the last step has no derivative");
    const rc_track_state state = rc_view_state(&track->basis, track->after);
    observe_all(model, &state, outputs);
    return RC_OK;
}

/* By differences over the step where there is no closed form: moved wheels, divided steps. */
rc_status rc_derive_track(rc_model *model, const double *seed, double *changes)
{
    rc_track *track = model->own;
    const size_t wheels = track->basis.wheels;
    double move = 0.0, force = 0.0;
    for (size_t i = 0; i < wheels; ++i) {
        move = fmax(move, fabs(seed[i]));
        force = fmax(force, fabs(seed[wheels + i]));
    }
    if (rc_count_parts(track->last_step) == 1.0)
        memcpy(track->before, track->operator_.start,
               rc_count_state(&track->basis) * sizeof(double));
    if (!(move > 0.0) && rc_count_parts(track->last_step) == 1.0)
        return differentiate(model, seed + wheels, changes);
    if (!(move > 0.0 || force > 0.0))
        return RC_OK; /* the changes are zeros already */
    const double factor = 1.0 / fmax(move / SMALL_MOVE, force / SMALL_FORCE);
    memset(model->known, 0, model->kind->kind_count); /* the outputs' place is borrowed */
    if (repeat(model, seed, factor, changes) != RC_OK ||
        repeat(model, seed, -factor, model->outputs) != RC_OK)
        return RC_DISCARD;
    for (size_t k = 0; k < model->output_count; ++k)
        changes[k] = (changes[k] - model->outputs[k]) / (2.0 * factor);
    return RC_OK;
}
