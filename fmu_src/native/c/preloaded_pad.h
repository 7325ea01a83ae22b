/* Three-parameter rail pad whose parameters depend on its preload; twin of
 * track_fmu/preloaded_pad.py. */
#ifndef RC_PRELOADED_PAD_H
#define RC_PRELOADED_PAD_H

#include "characteristic.h"

typedef struct {
    size_t rows; /* 0: there is none */
    double clip; /* N */
    double *preload, *branch_stiffness, *branch_damping; /* (rows), in one block of memory */
    double *place, *load, *tangent, *rise; /* (rows + 1): pieces, the first before the rows */
} rc_preloaded_pad;

/* Spring and dashpot in series, and their derivatives by the load. */
typedef struct {
    double stiffness, damping, stiffness_by_load, damping_by_load;
} rc_branch;

/* Makes a pad from columns of a table; 0 and a sentence if there is no such pad. */
int rc_make_preloaded_pad(rc_preloaded_pad *pad, const double *const columns[4], size_t rows,
                          double clip_preload, char *message, size_t room);

/* Load beyond the preload at rest. */
rc_jet rc_pad_at_rest(const rc_preloaded_pad *pad, double compression);

rc_branch rc_pad_branch(const rc_preloaded_pad *pad, double load);

void rc_free_preloaded_pad(rc_preloaded_pad *pad);

#endif
