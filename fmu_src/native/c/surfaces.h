/* What every wheel rolls over: the drops of its tread and of the railhead under it; twin of
 * vehicle_fmu/surfaces.py. */
#ifndef RC_SURFACES_H
#define RC_SURFACES_H

#include "flat.h"
#include "instance.h"
#include "tread.h"

/* Groups of parameters, in the order of the declaration, from wherever they begin. */
enum {
    RC_RAIL_IRREGULARITY, RC_FLAT_SHAPE, RC_FLAT_LENGTH, RC_FLAT_DEPTH, RC_FLAT_WHEEL,
    RC_FLAT_POSITION, RC_FLAT_PERIODIC, RC_FLAT_ROLLED, RC_OUT_OF_ROUNDNESS,
    RC_SURFACE_PARAMETER_COUNT
};

#define RC_SURFACE_PARAMETERS(first)                                                              \
    [(first) + RC_RAIL_IRREGULARITY] = {"rail_irregularity", RC_TEXT, RC_PARAMETER, RC_ONE},       \
    [(first) + RC_FLAT_SHAPE] = {"flat.shape", RC_TEXT, RC_PARAMETER, RC_ONE},                     \
    [(first) + RC_FLAT_LENGTH] = {"flat.length", RC_REAL, RC_PARAMETER, RC_ONE},                   \
    [(first) + RC_FLAT_DEPTH] = {"flat.depth", RC_REAL, RC_PARAMETER, RC_ONE},                     \
    [(first) + RC_FLAT_WHEEL] = {"flat.wheel", RC_INTEGER, RC_PARAMETER, RC_ONE},                  \
    [(first) + RC_FLAT_POSITION] = {"flat.position", RC_REAL, RC_PARAMETER, RC_ONE},               \
    [(first) + RC_FLAT_PERIODIC] = {"flat.periodic", RC_BOOLEAN, RC_PARAMETER, RC_ONE},            \
    [(first) + RC_FLAT_ROLLED] = {"flat.rolled", RC_BOOLEAN, RC_PARAMETER, RC_ONE},               \
    [(first) + RC_OUT_OF_ROUNDNESS] = {"wheel[#].out_of_roundness", RC_TEXT, RC_PARAMETER,         \
                                       RC_WHEELS}

typedef struct {
    rc_flat flat;
    rc_curve irregularity;
    rc_tread *treads; /* of every wheel; NULL where all are round */
    size_t wheels;
} rc_surfaces;

/* Makes the surfaces from the parameters of the model, whose groups begin at `first`. */
rc_status rc_make_surfaces(rc_model *model, rc_surfaces *surfaces, size_t first, double radius,
                           size_t wheels);

/* Drop under a wheel (from 0) at its position along the rail [m]. */
double rc_surface_drop(const rc_surfaces *surfaces, size_t wheel, double position);

/* Leaves surfaces that are made again or freed again. */
void rc_free_surfaces(rc_surfaces *surfaces);

#endif
