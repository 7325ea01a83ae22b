/* The start of the track with its contacts: static equilibrium under the loads of a vehicle. */
#include <math.h>

#include "contact.h"
#include "track_contact.h"

#define INSTANT 1e-6 /* s, over which the rate of a surface is taken at the start */
#define SWAY 1.0 /* s, over which bodies above the wheels smooth it; about a period of car bodies */

/* Loads of the wheels at the start, which must not be below zero, into own->force. */
static rc_status take_loads(rc_model *model)
{
    rc_track_contact *own = model->own;
    for (size_t i = 0; i < own->track.basis.wheels; ++i) {
        const double load = own->force[i] = own->static_load + rc_values(model, LOAD_CHANGE)[i];
        if (!(load >= 0.0))
            return rc_fail(model, RC_ERROR,
                           "track: wheel %zu starts with a load of %g N, which must be at least 0: "
                           "begin where the rail is more even, or let the vehicle have the contacts",
                           i + 1, load);
    }
    return RC_OK;
}

/* How fast the surface sinks under a wheel, in the mean over a span. */
static double rate(const rc_track_contact *own, size_t wheel, double position, double span)
{
    const double half = 0.5 * span * own->track.initial_speed;
    return (rc_surface_drop(&own->surfaces, wheel, position + half) -
            rc_surface_drop(&own->surfaces, wheel, position - half)) / span;
}

rc_status rc_start_contact(rc_model *model)
{
    rc_track_contact *own = model->own;
    rc_track *track = &own->track;
    const rc_contact_state at = rc_view_contact(&track->basis, model->dynamic);
    rc_track_state state = rc_view_state(&track->basis, model->dynamic);
    const double *positions = rc_values(model, POSITION), *displacements = rc_values(model, DISPLACEMENT);
    if (rc_check_contact(model, RC_ERROR) != RC_OK || take_loads(model) != RC_OK)
        return RC_ERROR;
    if (rc_start_track(model, track, &state, positions, own->force) != RC_OK)
        return RC_ERROR;
    for (size_t i = 0; i < track->basis.wheels; ++i) {
        at.compression[i] = rc_hertz_compression(own->force[i], own->coefficient);
        at.origin[i] = state.displacement[i] + rc_surface_drop(&own->surfaces, i, positions[i]);
        at.origin[i] += at.compression[i] - displacements[i];
        at.ahead[i] = own->force[i];
        at.velocity[i] = rate(own, i, positions[i], INSTANT);
        at.mean_velocity[i] = rate(own, i, positions[i], SWAY);
    }
    *at.passed = 0.0;
    rc_begin_contact(own, &at, positions, rc_values(model, INITIAL_VELOCITY));
    return RC_OK;
}
