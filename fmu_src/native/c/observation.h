/* What can be observed on the track; twin of track_fmu/observation.py and bending.py.
 *
 * Everything is linear in the state for given positions and speeds, so that a change of the state
 * shows itself in the same way.
 */
#ifndef RC_OBSERVATION_H
#define RC_OBSERVATION_H

#include "track.h"

typedef enum {
    RC_RAIL_DISPLACEMENT,
    RC_RAIL_VELOCITY,
    RC_WHEEL_MOMENT,
    RC_GAUGE_MOMENT,
    RC_SLEEPER_DISPLACEMENT,
    RC_PAD_FORCE,
    RC_BALLAST_FORCE,
    RC_SLEEPER_MOMENT,
    RC_SLEEPER_CENTRE_MOMENT,
    RC_WINDOW_POSITION
} rc_observed;

/* Dual rows of the modal state and of its rate. */
void rc_view_motion(const rc_basis *basis, const rc_track_state *state, double *modal,
                    double *rate);

void rc_observe(rc_track *track, const rc_track_state *state, rc_observed what, double *values);

#endif
