/* The track as a model: its variables, its start, its steps. */
#include "track.h"

#include <math.h>
#include <string.h>

#include "observation.h"

enum {
    BENDING_STIFFNESS, SHEAR_STIFFNESS, MASS_PER_LENGTH, ROTARY_INERTIA, PAD_STIFFNESS, PAD_DAMPING,
    SLEEPER_MASS, SLEEPER_SPACING, BALLAST_STIFFNESS, BALLAST_DAMPING,
    BALLAST, BALLAST_ALPHA, BALLAST_BETA, BALLAST_DELTA,
    MODE_PAIRS, RESIDUAL_FLEXIBILITY, SUPPORTS_PER_WHEEL, INITIAL_SPEED, GAUGE_POSITION,
    POSITION, CONTACT_FORCE,
    FIRST_OUTPUT,
    LINEAR_INPUTS = FIRST_OUTPUT + RC_BALLAST_FORCE + 1
};

static const rc_group_kind KINDS[] = {
    [BENDING_STIFFNESS] = {"bending_stiffness", RC_REAL, RC_CONSTANT, RC_ONE},
    [SHEAR_STIFFNESS] = {"shear_stiffness", RC_REAL, RC_CONSTANT, RC_ONE},
    [MASS_PER_LENGTH] = {"mass_per_length", RC_REAL, RC_CONSTANT, RC_ONE},
    [ROTARY_INERTIA] = {"rotary_inertia_per_length", RC_REAL, RC_CONSTANT, RC_ONE},
    [PAD_STIFFNESS] = {"pad_stiffness", RC_REAL, RC_CONSTANT, RC_ONE},
    [PAD_DAMPING] = {"pad_damping", RC_REAL, RC_CONSTANT, RC_ONE},
    [SLEEPER_MASS] = {"sleeper_mass", RC_REAL, RC_CONSTANT, RC_ONE},
    [SLEEPER_SPACING] = {"sleeper_spacing", RC_REAL, RC_CONSTANT, RC_ONE},
    [BALLAST_STIFFNESS] = {"ballast_stiffness", RC_REAL, RC_CONSTANT, RC_ONE},
    [BALLAST_DAMPING] = {"ballast_damping", RC_REAL, RC_CONSTANT, RC_ONE},
    [BALLAST] = {"ballast", RC_TEXT, RC_PARAMETER, RC_ONE},
    [BALLAST_ALPHA] = {"ballast_alpha", RC_REAL, RC_PARAMETER, RC_ONE},
    [BALLAST_BETA] = {"ballast_beta", RC_REAL, RC_PARAMETER, RC_ONE},
    [BALLAST_DELTA] = {"ballast_delta", RC_REAL, RC_PARAMETER, RC_ONE},
    [MODE_PAIRS] = {"mode_pairs", RC_INTEGER, RC_CONSTANT, RC_ONE},
    [RESIDUAL_FLEXIBILITY] = {"residual_flexibility", RC_BOOLEAN, RC_CONSTANT, RC_ONE},
    [SUPPORTS_PER_WHEEL] = {"supports_per_wheel", RC_INTEGER, RC_PARAMETER, RC_ONE},
    [INITIAL_SPEED] = {"initial_speed", RC_REAL, RC_PARAMETER, RC_ONE},
    [GAUGE_POSITION] = {"gauge[#].position", RC_REAL, RC_PARAMETER, RC_GAUGES},
    [POSITION] = {"wheel[#].position", RC_REAL, RC_INPUT, RC_WHEELS},
    [CONTACT_FORCE] = {"wheel[#].contact_force", RC_REAL, RC_INPUT, RC_WHEELS},
    [FIRST_OUTPUT + RC_RAIL_DISPLACEMENT] = {"wheel[#].rail_displacement", RC_REAL, RC_OUTPUT,
                                             RC_WHEELS},
    [FIRST_OUTPUT + RC_RAIL_VELOCITY] = {"wheel[#].rail_velocity", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [FIRST_OUTPUT + RC_WHEEL_MOMENT] = {"wheel[#].bending_moment", RC_REAL, RC_OUTPUT, RC_WHEELS},
    [FIRST_OUTPUT + RC_GAUGE_MOMENT] = {"gauge[#].bending_moment", RC_REAL, RC_OUTPUT, RC_GAUGES},
    [FIRST_OUTPUT + RC_SLEEPER_DISPLACEMENT] = {"sleeper[#].displacement", RC_REAL, RC_OUTPUT,
                                                RC_SUPPORTS},
    [FIRST_OUTPUT + RC_PAD_FORCE] = {"pad[#].force", RC_REAL, RC_OUTPUT, RC_SUPPORTS},
    [FIRST_OUTPUT + RC_BALLAST_FORCE] = {"ballast[#].force", RC_REAL, RC_OUTPUT, RC_SUPPORTS},
    [LINEAR_INPUTS] = {"linear_inputs", RC_BOOLEAN, RC_PARAMETER, RC_ONE},
};

#define MOST_PARTS 1e6 /* of a step; half a minute of work */

static rc_status open_track(rc_model *model)
{
    rc_track *track = model->own;
    const rc_status status = rc_read_basis(model, &track->basis);
    if (status != RC_OK)
        return status;
    model->dimensions[RC_WHEELS] = track->basis.wheels;
    model->dimensions[RC_GAUGES] = track->basis.gauges;
    model->dimensions[RC_SUPPORTS] = track->basis.supports;
    model->dynamic_count = rc_count_state(&track->basis);
    return RC_OK;
}

static void release(rc_model *model)
{
    rc_release_track(model->own);
}

static rc_status read_ballast(rc_model *model, rc_track *track)
{
    const char *kind = rc_text(model, BALLAST);
    track->state_dependent = strcmp(kind, "state_dependent") == 0;
    if (!track->state_dependent && strcmp(kind, "linear") != 0)
        return rc_fail(model, RC_ERROR, "track: ballast is '%s'; it must be 'state_dependent' or "
                                        "'linear'", kind);
    track->law = (rc_ballast_law){
        .alpha = *rc_values(model, BALLAST_ALPHA),
        .beta = *rc_values(model, BALLAST_BETA),
        .delta = *rc_values(model, BALLAST_DELTA),
        .tau = track->basis.ballast_damping / track->basis.ballast_stiffness};
    const rc_ballast_law *law = &track->law;
    if (track->state_dependent &&
        !(isfinite(law->alpha) && isfinite(law->beta) && isfinite(law->delta)))
        return rc_fail(model, RC_ERROR, "ballast: alpha = %g, beta = %g, delta = %g must be finite "
                                        "numbers", law->alpha, law->beta, law->delta);
    return RC_OK;
}

rc_status rc_refuse_position(rc_model *model, rc_status status, double position)
{
    return rc_fail(model, status,
                   "track: position %.17g m lies outside the track of 0 to %g m; start later, stop "
                   "earlier or use more bays", position,
                   ((const rc_track *)model->own)->basis.track_length);
}

static rc_status prepare(rc_model *model)
{
    rc_track *track = model->own;
    const double supports = *rc_values(model, SUPPORTS_PER_WHEEL);
    if (!(supports >= 1.0))
        return rc_fail(model, RC_ERROR, "track: supports_per_wheel = %g must be at least 1",
                       supports);
    track->per_wheel =
        supports < (double)track->basis.supports ? (size_t)supports : track->basis.supports;
    track->initial_speed = *rc_values(model, INITIAL_SPEED);
    model->linear = *rc_values(model, LINEAR_INPUTS) != 0.0;
    if (!isfinite(track->initial_speed))
        return rc_fail(model, RC_ERROR, "track: initial_speed = %g m/s must be finite",
                       track->initial_speed);
    if (read_ballast(model, track) != RC_OK || rc_claim_track(model, track) != RC_OK)
        return RC_ERROR;
    for (size_t k = 0; k < track->basis.gauges; ++k) {
        const double position = rc_values(model, GAUGE_POSITION)[k];
        if (!rc_locate(&track->basis, position, &track->gauges[k]))
            return rc_refuse_position(model, RC_ERROR, position);
    }
    return RC_OK;
}

/* Refuses wheels beyond the track and forces that are no numbers; leaves the places of the wheels
 * in track->points. */
static rc_status check_inputs(rc_model *model, rc_status otherwise)
{
    rc_track *track = model->own;
    const double *forces = rc_values(model, CONTACT_FORCE);
    const double *positions = rc_values(model, POSITION);
    for (size_t i = 0; i < track->basis.wheels; ++i)
        if (!isfinite(forces[i]))
            return rc_fail(model, otherwise,
                           "track: contact force %g N of wheel %zu must be a finite number; look "
                           "for the cause in the vehicle", forces[i], i + 1);
    for (size_t i = 0; i < track->basis.wheels; ++i)
        if (!rc_locate(&track->basis, positions[i], &track->points[i]))
            return rc_refuse_position(model, otherwise, positions[i]);
    return RC_OK;
}

static rc_status start(rc_model *model)
{
    rc_track *track = model->own;
    rc_track_state state = rc_view_state(&track->basis, model->dynamic);
    const double *positions = rc_values(model, POSITION);
    if (check_inputs(model, RC_ERROR) != RC_OK)
        return RC_ERROR;
    rc_choose_supports(track, positions);
    if (!rc_static_start(track, &state, rc_values(model, CONTACT_FORCE)))
        return rc_fail(model, RC_ERROR, "track: no static equilibrium found under the contact "
                                        "forces; check the ballast law");
    memcpy(state.position, positions, track->basis.wheels * sizeof(double));
    return RC_OK;
}

double rc_count_parts(double step)
{
    return fmax(1.0, ceil(step / RC_LONGEST_STEP - 1e-9));
}

int rc_advance_track(rc_track *track, double *dynamic, double step, const double *positions,
                     const double *forces)
{
    const rc_basis *basis = &track->basis;
    const size_t size = rc_count_state(basis) * sizeof(double);
    const double parts = rc_count_parts(step);
    rc_track_state state = rc_view_state(basis, dynamic);
    if (parts > 1.0)
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
        rc_prepare_operator(track, dynamic, step / parts, track->linear, track->position);
        if (!rc_apply_operator(track, &state, track->force)) {
            if (parts > 1.0)
                memcpy(dynamic, track->before, size);
            return 0;
        }
    }
    return 1;
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
    if (!rc_advance_track(track, model->dynamic, step, rc_values(model, POSITION),
                          rc_values(model, CONTACT_FORCE)))
        return rc_fail(model, RC_DISCARD, "track: the state-dependent forces did not converge over "
                                          "a step of %.3g s; use a shorter step", step);
    track->last_step = step;
    return RC_OK;
}

static rc_status jump_track(rc_model *model)
{
    rc_track *track = model->own;
    rc_track_state state = rc_view_state(&track->basis, model->dynamic);
    if (check_inputs(model, RC_DISCARD) != RC_OK)
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
