/* The linear track under loads that move steadily, and under increments as they come: twin of what
 * track_fmu/static_start.py works out of modes and residual.
 *
 * The modal state follows the moving load quasi-steadily: q = -Q / lambda - Q' / lambda^2.
 */
#ifndef RC_QUASI_STATIC_H
#define RC_QUASI_STATIC_H

#include "track.h"

/* Where everything lies in the scratch of the track while the equilibrium is sought. */
typedef struct {
    double *increment, *rate_of_increment; /* the unknowns, (stride) each */
    double *deformation, *rate, *tangent, *defect, *change, *new_rate;
    double *start, *full; /* increments before the last change, and that change */
    double *still;        /* zeros */
    double *weight;       /* compliance times the last change */
    double *free_rate;    /* without that of the increments */
    double *residual;     /* (stride): deformation by the contact forces, without modes */
    double *compliance;  /* (stride, stride), residual flexibility included */
    double *flexibility; /* (stride, stride), residual only */
    double *matrix;
    double *contact_load, *contact_load_rate, *load_rate, *modal_rate; /* rows */
} rc_quasi_static;

rc_quasi_static rc_lay_out_quasi_static(rc_track *track);

/* Takes the loads of the wheels at track->points: all that does not change from sweep to sweep. */
void rc_load_quasi_statically(rc_track *track, const rc_quasi_static *at, const double *forces);

/* Finds modal state, load and deformations under the present increments; track->scratch holds the
 * weights of the modes as a complex row. */
void rc_deform_quasi_statically(rc_track *track, const rc_quasi_static *at, rc_track_state *state);

/* Finds the displacements of the rail under the wheels. */
void rc_find_displacements(rc_track *track, const rc_quasi_static *at, const double *forces,
                           rc_track_state *state);

#endif
