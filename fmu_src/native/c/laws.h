/* Force increments of ballast and pads, on top of their linear springs and dampers; twins of
 * track_fmu/ballast.py, total_ballast.py, heavy_ballast.py, pads.py and viscoelastic_pads.py. */
#ifndef RC_LAWS_H
#define RC_LAWS_H

#include "preloaded_pad.h"
#include "support_line.h"
#include "supports.h"

typedef enum {
    RC_NO_INCREMENT, /* linear, and the same at every support */
    RC_PLAIN,        /* the polynomial at every support, Eq. (27) and (30) */
    RC_TOTAL,        /* a characteristic, support by support */
    RC_VISCOELASTIC
} rc_law_kind;

typedef struct {
    rc_law_kind ballast, pad;
    size_t supports;
    rc_ballast_law plain;
    rc_characteristic bed, spring; /* of RC_TOTAL: ballast, pad */
    rc_preloaded_pad viscoelastic;
    double ballast_stiffness, ballast_damping, pad_stiffness, pad_damping; /* linear */
    int tangent_damping, pulls;
    rc_support_line line;
    int inertial, mass_grows; /* whether forces depend on accelerations */
    double ballast_mass, sleeper_mass; /* kg, nominal */
    double sleeper_weight, rail_weight; /* N, nominal, under one rail seat */
} rc_laws;

/* What viscoelastic pads remember, (supports) each, and the step that begins with it. */
typedef struct {
    double step; /* s; 0: slow motion, nothing is remembered */
    const double *branch_force, *compression, *known;
} rc_pad_memory;

/* How the active components move; no accelerations in slow motion, or if no law asks for them. */
typedef struct {
    const double *deformation, *rate, *acceleration;
} rc_motion;

/* Derivatives of the increments of the active components by their motion. */
typedef struct {
    double *stiffness, *damping, *mass; /* the last is left alone if there are no accelerations */
} rc_tangents;

/* A whole force and its derivatives. */
typedef struct {
    double total, by_deformation, by_rate, by_acceleration;
} rc_response;

/* Of the ballast under a sleeper, without its inertia and with it. */
rc_response rc_press_ballast(const rc_laws *laws, const rc_support *own, double deformation,
                             double rate);
rc_response rc_press_heavy_ballast(const rc_laws *laws, const rc_support *own, double deformation,
                                   double rate, double acceleration);

/* What a sleeper weighs beyond the nominal one. */
static inline double rc_more_mass(const rc_laws *laws, const rc_support *own)
{
    return (own->of[RC_SLEEPER_MASS_FACTOR] - 1.0) * laws->sleeper_mass;
}

static inline size_t rc_kinds(const rc_laws *laws)
{
    return (laws->ballast != RC_NO_INCREMENT) + (size_t)(laws->pad != RC_NO_INCREMENT);
}

/* Whether tangents have to be taken where they are used. */
static inline int rc_is_stiff(const rc_laws *laws)
{
    return laws->ballast > RC_PLAIN || laws->pad != RC_NO_INCREMENT;
}

/* Number of components with a place in the state: increments of pads are zero without a law. */
static inline size_t rc_increments(const rc_laws *laws)
{
    return laws->pad != RC_NO_INCREMENT ? 2 * laws->supports : laws->supports;
}

/* Increments [N] of the active components. */
void rc_law_forces(const rc_laws *laws, const rc_active *active, const rc_pad_memory *memory,
                   const rc_motion *motion, double *force);

/* Their derivatives; `exact` ones hold at the rate given where the plain law's hold at rest. */
void rc_law_tangents(const rc_laws *laws, const rc_active *active, const rc_pad_memory *memory,
                     const rc_motion *motion, int exact, const rc_tangents *tangents);

/* What the pads among the active components remember of the end of a step; the arrays begin as
 * zeros. */
void rc_law_memories(const rc_laws *laws, const rc_active *active, const rc_pad_memory *memory,
                     const rc_motion *motion, double *branch_force, double *compression,
                     double *known);

/* Frees what tables take. */
void rc_free_laws(rc_laws *laws);

#endif
