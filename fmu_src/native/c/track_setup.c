#include "track_setup.h"

#include <math.h>
#include <string.h>

#include "window.h"

rc_status rc_open_track(rc_model *model, rc_track *track)
{
    const rc_status status = rc_read_basis(model, &track->basis);
    if (status != RC_OK)
        return status;
    model->dimensions[RC_WHEELS] = track->basis.wheels;
    model->dimensions[RC_GAUGES] = track->basis.gauges;
    model->dimensions[RC_SUPPORTS] = track->basis.supports;
    return RC_OK;
}

static rc_status refuse_position(rc_model *model, const rc_track *track, rc_status status,
                                 double position)
{
    return rc_fail(model, status,
                   "track: position %.17g m lies outside the track of 0 to %g m; start later, stop "
                   "earlier or use more bays", position, track->basis.track_length);
}

rc_status rc_prepare_track(rc_model *model, rc_track *track)
{
    const double supports = *rc_values(model, SUPPORTS_PER_WHEEL);
    if (!(supports >= 1.0))
        return rc_fail(model, RC_ERROR, "track: supports_per_wheel = %g must be at least 1",
                       supports);
    track->per_wheel =
        supports < (double)track->basis.supports ? (size_t)supports : track->basis.supports;
    track->initial_speed = *rc_values(model, INITIAL_SPEED);
    if (!isfinite(track->initial_speed))
        return rc_fail(model, RC_ERROR, "track: initial_speed = %g m/s must be finite",
                       track->initial_speed);
    track->endless = *rc_values(model, ENDLESS) != 0.0;
    if (rc_read_laws(model, track) != RC_OK)
        return RC_ERROR;
    if (rc_claim_track(model, track) != RC_OK)
        return RC_ERROR;
    for (size_t k = 0; k < track->basis.gauges; ++k) {
        const double position = track->gauge_position[k] = rc_values(model, GAUGE_POSITION)[k];
        if (!track->endless && !(position >= 0.0 && position <= track->basis.track_length))
            return refuse_position(model, track, RC_ERROR, position);
    }
    return RC_OK;
}

rc_status rc_refuse_lost(rc_model *model, const rc_track *track, rc_status status)
{
    if (!track->endless)
        return refuse_position(model, track, status, track->lost);
    return rc_fail(model, status,
                   "track: position %.17g m lies outside the window of %g to %g m that moves with "
                   "the wheels; use shorter steps or more bays", track->lost, track->lost_window,
                   track->lost_window + track->basis.track_length);
}

rc_status rc_check_wheels(rc_model *model, rc_track *track, const double *positions,
                          rc_status otherwise)
{
    if (!track->endless)
        return rc_locate_wheels(model, track, positions, otherwise);
    for (size_t i = 0; i < track->basis.wheels; ++i)
        if (!(fabs(positions[i]) <= RC_FARTHEST))
            return rc_fail(model, otherwise,
                           "track: position %.17g m must be a number of at most %g m; look for the "
                           "cause in the vehicle", positions[i], RC_FARTHEST);
    return RC_OK;
}

rc_status rc_locate_wheels(rc_model *model, rc_track *track, const double *positions,
                           rc_status otherwise)
{
    const rc_track_state state = rc_view_state(&track->basis, model->dynamic);
    if (!rc_find_wheels(track, &state, positions))
        return rc_refuse_lost(model, track, otherwise);
    return RC_OK;
}

rc_status rc_start_track(rc_model *model, rc_track *track, rc_track_state *state,
                         const double *positions, const double *forces)
{
    rc_centre_window(track, state, positions);
    if (rc_locate_wheels(model, track, positions, RC_ERROR) != RC_OK)
        return RC_ERROR;
    rc_choose_supports(track, state, positions);
    if (!rc_static_start(track, state, forces))
        return rc_fail(model, RC_ERROR, "track: no static equilibrium found under the contact "
                                        "forces, or none in which all loads on ballast and pads "
                                        "rise with displacement; check their laws");
    memcpy(state->position, positions, track->basis.wheels * sizeof(double));
    return RC_OK;
}
