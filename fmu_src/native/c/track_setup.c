#include "track_setup.h"

#include <math.h>
#include <string.h>

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
    if (rc_read_laws(model, track) != RC_OK || rc_claim_track(model, track) != RC_OK)
        return RC_ERROR;
    for (size_t k = 0; k < track->basis.gauges; ++k) {
        const double position = rc_values(model, GAUGE_POSITION)[k];
        if (!rc_locate(&track->basis, position, &track->gauges[k]))
            return rc_refuse_position(model, track, RC_ERROR, position);
    }
    return RC_OK;
}

rc_status rc_refuse_position(rc_model *model, const rc_track *track, rc_status status,
                             double position)
{
    return rc_fail(model, status,
                   "track: position %.17g m lies outside the track of 0 to %g m; start later, stop "
                   "earlier or use more bays", position, track->basis.track_length);
}

rc_status rc_locate_wheels(rc_model *model, rc_track *track, const double *positions,
                           rc_status otherwise)
{
    for (size_t i = 0; i < track->basis.wheels; ++i)
        if (!rc_locate(&track->basis, positions[i], &track->points[i]))
            return rc_refuse_position(model, track, otherwise, positions[i]);
    return RC_OK;
}

rc_status rc_start_track(rc_model *model, rc_track *track, rc_track_state *state,
                         const double *positions, const double *forces)
{
    rc_choose_supports(track, positions);
    if (!rc_static_start(track, state, forces))
        return rc_fail(model, RC_ERROR, "track: no static equilibrium found under the contact "
                                        "forces, or none in which all loads on ballast and pads "
                                        "rise with displacement; check their laws");
    memcpy(state->position, positions, track->basis.wheels * sizeof(double));
    return RC_OK;
}
