/* The track with the contacts on its side: wheel positions and displacements in, forces out; twin
 * of track_fmu/contact_track.py. */
#ifndef RC_TRACK_CONTACT_H
#define RC_TRACK_CONTACT_H

#include "contact_solution.h"
#include "continuation.h"
#include "surfaces.h"
#include "track_setup.h"

/* Groups of variables, in the order of the declaration. */
enum {
    STATIC_WHEEL_LOAD = RC_TRACK_PARAMETER_COUNT,
    WHEEL_RADIUS,
    HERTZ_COEFFICIENT,
    SURFACE,
    POSITION = SURFACE + RC_SURFACE_PARAMETER_COUNT,
    DISPLACEMENT,
    LOAD_CHANGE,
    INITIAL_VELOCITY,
    CONTACT_FORCE,
    CONTACT_FORCE_AHEAD,
    GAP,
    IN_CONTACT,
    STATIC_DISPLACEMENT,
    STATIC_VELOCITY,
    MEAN_VELOCITY,
    TRACK_OUTPUT,
    LINEAR_INPUTS = TRACK_OUTPUT + RC_TRACK_OUTPUT_COUNT
};

#define RC_LONGEST_PART 2e-4 /* s; beyond it forces on straight lines resolve no strike */

/* What it remembers beside the track's own state; twin of track_fmu/contact_state.py. */
typedef struct {
    double *compression, *ahead, *origin; /* (wheels) */
    double *velocity, *mean_velocity;     /* (wheels); of the surface at the start */
    rc_history history;                   /* of positions, then displacements, as last given */
    double *passed;                       /* s; since the newest were given */
} rc_contact_state;

typedef struct {
    rc_track track;
    rc_surfaces surfaces;
    double coefficient, static_load;
    rc_contact_work work;
    double *before, *after; /* dynamic values before the last step, and where it is repeated */
    double *given;          /* (2 wheels): inputs of the last step */
    double *moved, *rate;   /* (2 wheels): likewise, beside them; of a beginning */
    double *wheels;         /* (2 wheels): positions and displacements at the end of a part */
    double *level, *force;  /* (wheels) */
    double last_step;
    int linear; /* of the last step */
    void *memory;
} rc_track_contact;

/* Number of dynamic values: those of the track, then its own. */
size_t rc_count_contact(const rc_basis *basis);
rc_contact_state rc_view_contact(const rc_basis *basis, double *dynamic);

/* Claims what the parameters of the prepared track ask for. */
rc_status rc_claim_contact(rc_model *model, rc_track_contact *own);
void rc_release_contact(rc_track_contact *own);

/* Continues given positions and displacements, these with a velocity, from nothing else. */
void rc_begin_contact(rc_track_contact *own, const rc_contact_state *at, const double *given,
                      const double *velocity);

/* Takes over positions and displacements that hold now. */
void rc_take_contact(rc_track_contact *own, const rc_contact_state *at, const double *given);

/* Writes what is doubtful about a first step of given start values; nothing if nothing is. */
void rc_doubt_contact(const rc_track_contact *own, const rc_contact_state *at, double step,
                      const double *given, char *message, size_t room);

/* Into how many parts a step is divided. */
double rc_count_contact_parts(double step);

/* One step of the dynamic values, which are spoilt unless it is made. */
rc_advance rc_advance_contact(rc_track_contact *own, double *dynamic, double step,
                              const double *given, int linear);

/* Refuses wheels beyond the track and other values that are no numbers, even where they matter at
 * the start only. */
rc_status rc_check_contact(rc_model *model, rc_status otherwise);

/* Static equilibrium; see rc_class. */
rc_status rc_start_contact(rc_model *model);

#endif
