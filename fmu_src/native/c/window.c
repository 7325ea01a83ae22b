#include "window.h"

#include <math.h>

#define MOVES_PER_LENGTH 5 /* it moves by a fifth of its length */

/* How far the middle of the wheels is ahead of that of a window at `offset` [bays]. */
static double bays_ahead(const rc_basis *basis, const double *positions, double offset)
{
    double least = positions[0], most = positions[0];
    for (size_t i = 1; i < basis->wheels; ++i) {
        least = fmin(least, positions[i]);
        most = fmax(most, positions[i]);
    }
    const double bays = (double)(basis->supports + 1);
    return 0.5 * (most + least) / basis->spacing - 0.5 * bays - offset;
}

void rc_centre_window(rc_track *track, const rc_track_state *state, const double *positions)
{
    *state->offset = track->endless ? rint(bays_ahead(&track->basis, positions, 0.0)) : 0.0;
}

int rc_find_wheels(rc_track *track, const rc_track_state *state, const double *positions)
{
    const double begin = rc_window_position(&track->basis, state);
    for (size_t i = 0; i < track->basis.wheels; ++i)
        if (!rc_locate(&track->basis, positions[i] - begin, &track->points[i])) {
            track->lost = positions[i];
            track->lost_window = begin;
            return 0;
        }
    return 1;
}

/* Bays by which it has to move now, below zero for wheels that run back. */
static ptrdiff_t due_bays(const rc_track *track, const rc_track_state *state)
{
    const size_t fifth = (track->basis.supports + 1) / MOVES_PER_LENGTH;
    const ptrdiff_t bays = fifth > 1 ? (ptrdiff_t)fifth : 1;
    const double ahead = bays_ahead(&track->basis, state->position, *state->offset);
    const double limit = 0.5 * ((double)bays + 1.0);
    if (ahead > limit)
        return bays;
    return ahead < -limit ? -bays : 0;
}

int rc_follow_wheels(rc_track *track, rc_track_state *state, const double *positions)
{
    const ptrdiff_t bays = due_bays(track, state);
    if (bays != 0) {
        if (!rc_find_wheels(track, state, state->position))
            return 0;
        rc_shift_field(track, state, bays);
        *state->offset += (double)bays;
        if (!rc_find_wheels(track, state, state->position))
            return 0;
        rc_project_field(track, state);
        rc_load_track(track, state);
    }
    return rc_find_wheels(track, state, positions);
}
