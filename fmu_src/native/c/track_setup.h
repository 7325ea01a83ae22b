/* What the models of a track have in common as models: parameters, outputs, checks. */
#ifndef RC_TRACK_SETUP_H
#define RC_TRACK_SETUP_H

#include "observation.h"
#include "track.h"

/* Groups that the variables of every track begin with, in the order of the declaration. */
enum {
    BENDING_STIFFNESS, SHEAR_STIFFNESS, MASS_PER_LENGTH, ROTARY_INERTIA, PAD_STIFFNESS, PAD_DAMPING,
    SLEEPER_MASS, SLEEPER_SPACING, BALLAST_STIFFNESS, BALLAST_DAMPING,
    SLEEPER, SLEEPER_HALF_LENGTH, SLEEPER_RAIL_SEAT, SLEEPER_BENDING_STIFFNESS,
    SLEEPER_SHEAR_STIFFNESS, SLEEPER_MASS_PER_LENGTH, SLEEPER_ROTARY_INERTIA, SLEEPER_ELEMENTS,
    BALLAST, BALLAST_ALPHA, BALLAST_BETA, BALLAST_DELTA,
    MODE_PAIRS, RESIDUAL_FLEXIBILITY, SUPPORTS_PER_WHEEL, INITIAL_SPEED, ENDLESS,
    BALLAST_SLOPE, BALLAST_TANGENT_DAMPING, BALLAST_PULLS, PAD, CLIP_PRELOAD, SUPPORTS, SUPPORTS_REPEAT,
    PAD_STIFFNESS_FACTOR, PAD_DAMPING_FACTOR, BALLAST_STIFFNESS_FACTOR, BALLAST_DAMPING_FACTOR,
    SUPPORT_GAP, FASTENED, GAUGE_POSITION,
    RC_TRACK_PARAMETER_COUNT
};

/* Behind it groups are in the order of rc_property. */
#define RC_FIRST_SUPPORT_PROPERTY PAD_STIFFNESS_FACTOR

#define RC_TRACK_PARAMETERS                                                                       \
    [BENDING_STIFFNESS] = {"bending_stiffness", RC_REAL, RC_CONSTANT, RC_ONE},                     \
    [SHEAR_STIFFNESS] = {"shear_stiffness", RC_REAL, RC_CONSTANT, RC_ONE},                         \
    [MASS_PER_LENGTH] = {"mass_per_length", RC_REAL, RC_CONSTANT, RC_ONE},                         \
    [ROTARY_INERTIA] = {"rotary_inertia_per_length", RC_REAL, RC_CONSTANT, RC_ONE},                \
    [PAD_STIFFNESS] = {"pad_stiffness", RC_REAL, RC_CONSTANT, RC_ONE},                             \
    [PAD_DAMPING] = {"pad_damping", RC_REAL, RC_CONSTANT, RC_ONE},                                 \
    [SLEEPER_MASS] = {"sleeper_mass", RC_REAL, RC_CONSTANT, RC_ONE},                               \
    [SLEEPER_SPACING] = {"sleeper_spacing", RC_REAL, RC_CONSTANT, RC_ONE},                         \
    [BALLAST_STIFFNESS] = {"ballast_stiffness", RC_REAL, RC_CONSTANT, RC_ONE},                     \
    [BALLAST_DAMPING] = {"ballast_damping", RC_REAL, RC_CONSTANT, RC_ONE},                         \
    [SLEEPER] = {"sleeper", RC_TEXT, RC_CONSTANT, RC_ONE},                                         \
    [SLEEPER_HALF_LENGTH] = {"sleeper_half_length", RC_REAL, RC_CONSTANT, RC_ONE},                 \
    [SLEEPER_RAIL_SEAT] = {"sleeper_rail_seat", RC_REAL, RC_CONSTANT, RC_ONE},                     \
    [SLEEPER_BENDING_STIFFNESS] = {"sleeper_bending_stiffness", RC_REAL, RC_CONSTANT, RC_ONE},     \
    [SLEEPER_SHEAR_STIFFNESS] = {"sleeper_shear_stiffness", RC_REAL, RC_CONSTANT, RC_ONE},         \
    [SLEEPER_MASS_PER_LENGTH] = {"sleeper_mass_per_length", RC_REAL, RC_CONSTANT, RC_ONE},         \
    [SLEEPER_ROTARY_INERTIA] = {"sleeper_rotary_inertia_per_length", RC_REAL, RC_CONSTANT,         \
                                RC_ONE},                                                           \
    [SLEEPER_ELEMENTS] = {"sleeper_elements", RC_INTEGER, RC_CONSTANT, RC_ONE},                    \
    [BALLAST] = {"ballast", RC_TEXT, RC_PARAMETER, RC_ONE},                                        \
    [BALLAST_ALPHA] = {"ballast_alpha", RC_REAL, RC_PARAMETER, RC_ONE},                            \
    [BALLAST_BETA] = {"ballast_beta", RC_REAL, RC_PARAMETER, RC_ONE},                              \
    [BALLAST_DELTA] = {"ballast_delta", RC_REAL, RC_PARAMETER, RC_ONE},                            \
    [MODE_PAIRS] = {"mode_pairs", RC_INTEGER, RC_CONSTANT, RC_ONE},                                \
    [RESIDUAL_FLEXIBILITY] = {"residual_flexibility", RC_BOOLEAN, RC_CONSTANT, RC_ONE},            \
    [SUPPORTS_PER_WHEEL] = {"supports_per_wheel", RC_INTEGER, RC_PARAMETER, RC_ONE},               \
    [INITIAL_SPEED] = {"initial_speed", RC_REAL, RC_PARAMETER, RC_ONE},                            \
    [ENDLESS] = {"endless", RC_BOOLEAN, RC_PARAMETER, RC_ONE},                                     \
    [BALLAST_SLOPE] = {"ballast_slope", RC_REAL, RC_PARAMETER, RC_ONE},                            \
    [BALLAST_TANGENT_DAMPING] = {"ballast_tangent_damping", RC_BOOLEAN, RC_PARAMETER, RC_ONE},     \
    [BALLAST_PULLS] = {"ballast_pulls", RC_BOOLEAN, RC_PARAMETER, RC_ONE},                         \
    [PAD] = {"pad", RC_TEXT, RC_PARAMETER, RC_ONE},                                                \
    [CLIP_PRELOAD] = {"clip_preload", RC_REAL, RC_PARAMETER, RC_ONE},                              \
    [SUPPORTS] = {"supports", RC_TEXT, RC_PARAMETER, RC_ONE},                                      \
    [SUPPORTS_REPEAT] = {"supports_repeat", RC_BOOLEAN, RC_PARAMETER, RC_ONE},                     \
    [PAD_STIFFNESS_FACTOR] = {"support[#].pad_stiffness_factor", RC_REAL, RC_PARAMETER,            \
                              RC_SUPPORTS},                                                        \
    [PAD_DAMPING_FACTOR] = {"support[#].pad_damping_factor", RC_REAL, RC_PARAMETER, RC_SUPPORTS},  \
    [BALLAST_STIFFNESS_FACTOR] = {"support[#].ballast_stiffness_factor", RC_REAL, RC_PARAMETER,    \
                                  RC_SUPPORTS},                                                    \
    [BALLAST_DAMPING_FACTOR] = {"support[#].ballast_damping_factor", RC_REAL, RC_PARAMETER,        \
                                RC_SUPPORTS},                                                      \
    [SUPPORT_GAP] = {"support[#].gap", RC_REAL, RC_PARAMETER, RC_SUPPORTS},                        \
    [FASTENED] = {"support[#].fastened", RC_BOOLEAN, RC_PARAMETER, RC_SUPPORTS},                   \
    [GAUGE_POSITION] = {"gauge[#].position", RC_REAL, RC_PARAMETER, RC_GAUGES}

/* Outputs of every track, in the order of rc_observed. */
#define RC_TRACK_OUTPUT_COUNT (RC_WINDOW_POSITION + 1)
#define RC_TRACK_OUTPUTS(first)                                                                   \
    [(first) + RC_RAIL_DISPLACEMENT] = {"wheel[#].rail_displacement", RC_REAL, RC_OUTPUT,          \
                                        RC_WHEELS},                                                \
    [(first) + RC_RAIL_VELOCITY] = {"wheel[#].rail_velocity", RC_REAL, RC_OUTPUT, RC_WHEELS},      \
    [(first) + RC_WHEEL_MOMENT] = {"wheel[#].bending_moment", RC_REAL, RC_OUTPUT, RC_WHEELS},      \
    [(first) + RC_GAUGE_MOMENT] = {"gauge[#].bending_moment", RC_REAL, RC_OUTPUT, RC_GAUGES},      \
    [(first) + RC_SLEEPER_DISPLACEMENT] = {"sleeper[#].displacement", RC_REAL, RC_OUTPUT,          \
                                           RC_SUPPORTS},                                           \
    [(first) + RC_PAD_FORCE] = {"pad[#].force", RC_REAL, RC_OUTPUT, RC_SUPPORTS},                  \
    [(first) + RC_BALLAST_FORCE] = {"ballast[#].force", RC_REAL, RC_OUTPUT, RC_SUPPORTS},          \
    [(first) + RC_SLEEPER_MOMENT] = {"sleeper[#].bending_moment", RC_REAL, RC_OUTPUT,              \
                                     RC_SUPPORTS},                                                 \
    [(first) + RC_SLEEPER_CENTRE_MOMENT] = {"sleeper[#].centre_bending_moment", RC_REAL,           \
                                            RC_OUTPUT, RC_SUPPORTS},                                                  \
    [(first) + RC_WINDOW_POSITION] = {"window_position", RC_REAL, RC_OUTPUT, RC_ONE}

/* Reads the basis and says how many wheels, gauges and supports there are. */
rc_status rc_open_track(rc_model *model, rc_track *track);

/* Makes the laws of ballast and pads from the parameters. */
rc_status rc_read_laws(rc_model *model, rc_track *track);

/* Reads the parameters and claims what they ask for. */
rc_status rc_prepare_track(rc_model *model, rc_track *track);

/* Refuses wheels beyond the track, or of an endless one positions that are no numbers. */
rc_status rc_check_wheels(rc_model *model, rc_track *track, const double *positions,
                          rc_status otherwise);

/* Leaves the places of the wheels in track->points; refuses a wheel outside the window. */
rc_status rc_locate_wheels(rc_model *model, rc_track *track, const double *positions,
                           rc_status otherwise);

/* Refuses the wheel that rc_find_wheels did not find. */
rc_status rc_refuse_lost(rc_model *model, const rc_track *track, rc_status status);

/* Static equilibrium under wheels at these positions, the window around them. */
rc_status rc_start_track(rc_model *model, rc_track *track, rc_track_state *state,
                         const double *positions, const double *forces);

#endif
