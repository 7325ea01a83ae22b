/* The supports near the wheels and their state-dependent ballast; twins of track_fmu/supports.py,
 * components.py and ballast.py. */
#ifndef RC_SUPPORTS_H
#define RC_SUPPORTS_H

#include <stddef.h>

#include "basis.h"

/* Fourth-degree force increment with proportional damping, Eq. (27) and (30). */
typedef struct {
    double alpha, beta, delta; /* N/m2, N/m3, N/m4 */
    double tau;                /* s */
} rc_ballast_law;

/* Force increment [N], and its derivatives by deformation and rate where `rate` is 0. */
double rc_ballast_force(const rc_ballast_law *law, double deformation, double rate);
double rc_ballast_stiffness(const rc_ballast_law *law, double deformation);
double rc_ballast_damping(const rc_ballast_law *law, double deformation);

/* The derivative of the force by the deformation at any rate [N/m]. */
double rc_ballast_tangent(const rc_ballast_law *law, double deformation, double rate);

/* Components whose increments are accounted for, in ascending order. */
typedef struct {
    size_t count, stride;
    ptrdiff_t first_support; /* how many supports there are before the one of number 0 */
    size_t *number;      /* among all: ballast from 0 on, then pads */
    const double **rows; /* their modal deformation */
} rc_active;

/* Chooses ballast and pads, whichever is asked for, of the `per_wheel` supports nearest to every
 * wheel; `first` has room for the wheels. */
void rc_choose_active(rc_active *active, const rc_basis *basis, const double *positions,
                      size_t per_wheel, int ballast, int pads, size_t *first);

int rc_same_active(const rc_active *a, const rc_active *b);
void rc_copy_active(rc_active *to, const rc_active *from);

/* out[a, b] = Re sum_n factor_n rho_an rho_bn, for a `factor` with the weight in it. `scratch`
 * has room for RC_COUPLING_COLUMNS rows and that many strides. */
#define RC_COUPLING_COLUMNS 3 /* worked out at a time */
void rc_modal_coupling(double *out, const rc_active *active, const double *factor,
                       size_t half, double *scratch);

/* out[a, b] = out[a, b] + residual flexibility. */
void rc_add_residual(double *out, const rc_active *active, const rc_basis *basis);

#endif
