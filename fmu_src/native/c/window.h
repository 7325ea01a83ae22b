/* The part of an endless track that the model holds; twin of track_fmu/window.py and
 * window_shift.py. That of an ordinary track begins at 0 m and stays. */
#ifndef RC_WINDOW_H
#define RC_WINDOW_H

#include "track.h"

#define RC_FARTHEST 1e9 /* m; beyond it positions lose the digits of a step */

/* How many numbers there are for every field of displacements: rail nodes, then all degrees of
 * freedom of the sleepers. */
static inline size_t rc_field_size(const rc_basis *basis)
{
    return 2 * basis->nodes + basis->supports * basis->sleeper_size;
}

/* Where it begins [m]. */
static inline double rc_window_position(const rc_basis *basis, const rc_track_state *state)
{
    return *state->offset * basis->spacing;
}

/* Lays it around wheels at the start. */
void rc_centre_window(rc_track *track, const rc_track_state *state, const double *positions);

/* Leaves the places of wheels at `positions` in track->points; 0 if one is not in the window,
 * track->lost and track->lost_window saying which and in which. */
int rc_find_wheels(rc_track *track, const rc_track_state *state, const double *positions);

/* Takes displacements and velocities, with those of the truncated modes' static part, by so many
 * bays into track->field, and the increments along; the wheels are at track->points. */
void rc_shift_field(rc_track *track, rc_track_state *state, ptrdiff_t bays);

/* The modal state of that field, by the modes' biorthogonality, Eq. (7)-(11). */
void rc_project_field(rc_track *track, rc_track_state *state);

/* What a step to `positions` begins with: moves the window after the wheels if they have left its
 * middle, which depends on the state alone. 0 if a wheel is outside then, see rc_find_wheels. */
int rc_follow_wheels(rc_track *track, rc_track_state *state, const double *positions);

#endif
