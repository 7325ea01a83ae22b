/* The track in its modes, as the resource holds it; twin of track_fmu/reduction.py.
 *
 * Coordinates: deflection and rotation of every rail node, then the deformation of the ballast
 * under every sleeper (a weighted mean if it bends), then that of every pad.
 */
#ifndef RC_BASIS_H
#define RC_BASIS_H

#include <stddef.h>

#include "instance.h"

#define RC_INERTIA_COUNT 16

typedef struct {
    size_t wheels, gauges, elements, supports;
    size_t nodes, coordinates; /* elements + 1; 2 nodes + 2 supports */
    size_t modes, half, length; /* half: modes filled up; length of a row: twice that */
    size_t sleeper_size, seat; /* degrees of freedom of a sleeper, and which is its rail seat's */
    double element_length, spacing, shear_parameter, track_length;
    double pad_stiffness, pad_damping, ballast_stiffness, ballast_damping;
    const double *eigenvalues;  /* row */
    const double *inverses;     /* row of 1 / lambda */
    const double *weight;       /* half */
    const double *shape;        /* (coordinates, length), rows */
    const double *moment_shape; /* (nodes, length), rows */
    const double *flexibility;  /* (coordinates, coordinates) */
    const double *moment_flexibility; /* (nodes, coordinates) */
    const double *inertia; /* mass matrix of an element of the rail, by rows */
    const double *sleeper_mass, *sleeper_bed; /* of one sleeper, by rows; the bed's total is one */
    /* all degrees of freedom of the sleepers, one sleeper after the other; NULL if they are rigid,
     * whose displacements are coordinates */
    const double *bent_shape;       /* (supports sleeper_size, length), rows */
    const double *bent_flexibility; /* (coordinates, supports sleeper_size) */
    /* bending moments of the sleepers at all rail seats, then at all centres, then their mean
     * deflections; NULL if they are rigid */
    const double *sleeper_shape;       /* (3 supports, length), rows */
    const double *sleeper_flexibility; /* (3 supports, coordinates) */
} rc_basis;

rc_status rc_read_basis(rc_model *model, rc_basis *basis);

static inline const double *rc_shape(const rc_basis *basis, size_t coordinate)
{
    return basis->shape + coordinate * basis->length;
}

static inline const double *rc_flexibility(const rc_basis *basis, size_t coordinate)
{
    return basis->flexibility + coordinate * basis->coordinates;
}

/* Ballast, then pads. */
static inline size_t rc_component(const rc_basis *basis, size_t number)
{
    return 2 * basis->nodes + number;
}

static inline size_t rc_ballast(const rc_basis *basis, size_t support)
{
    return 2 * basis->nodes + support;
}

/* The rail above a sleeper. */
static inline size_t rc_above(const rc_basis *basis, size_t support)
{
    return 2 * (support + 1) * (basis->elements / (basis->supports + 1));
}

static inline size_t rc_pad(const rc_basis *basis, size_t support)
{
    return 2 * basis->nodes + basis->supports + support;
}

#endif
