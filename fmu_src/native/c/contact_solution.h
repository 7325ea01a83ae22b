/* Contact forces at the end of a step, at which wheels, contacts and track agree; twin of
 * track_fmu/contact_solution.py. */
#ifndef RC_CONTACT_SOLUTION_H
#define RC_CONTACT_SOLUTION_H

#include "track.h"

/* Where wheels, contacts and track might agree, and what is missing. */
typedef struct {
    double *compression, *force, *increment; /* (wheels), (wheels), (stride) */
    double *miss, *increment_miss;           /* (wheels) [m], (stride) [N] */
    double size;                             /* of both together [N] */
} rc_contact_trial;

/* Room for the iteration, and what it left: the increments are then those of the operator. */
typedef struct {
    rc_contact_trial trials[2];
    const rc_contact_trial *solution;
    double *change, *increment_change; /* (wheels), (stride) */
    double *push, *demand;             /* (wheels), (stride) */
    double *response;     /* (wheels, stride): of the increments to each contact force */
    double *relief;       /* (wheels, stride): of the rail by what is missing in the increments */
    double *displacement; /* (wheels, wheels): of the rail, increments included */
    double *matrix;       /* (wheels, rc_stride(wheels)) */
    size_t *pivot;        /* (wheels) */
} rc_contact_work;

/* Finds the contact forces of the step of the track's operator, at which the compressions are what
 * remains of the `level` of every wheel [m] over the rail. Starts from the compressions given; 0 if
 * the iteration does not converge. */
int rc_solve_contact(rc_track *track, rc_contact_work *work, double coefficient,
                     const double *level, const double *compression);

#endif
