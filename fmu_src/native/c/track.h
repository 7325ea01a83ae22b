/* The track as a dynamic model; twin of track_fmu/track_model.py. */
#ifndef RC_TRACK_H
#define RC_TRACK_H

#include "basis.h"
#include "exponential.h"
#include "laws.h"
#include "rail_point.h"
#include "supports.h"

#define RC_LONGEST_STEP 5e-4 /* s; longer ones are divided */
#define RC_SMALL_ROWS 14     /* strides in track->small */
#define RC_MOST_FORCE 1e30   /* N; nothing that follows from less overflows */

/* Where the dynamic values of a state are; twin of track_fmu/track_state.py. */
typedef struct {
    double *position, *speed, *force, *force_rate, *displacement; /* (wheels) */
    double *increment, *increment_rate; /* (2 supports): of ballast, then pads */
    double *branch_force, *compression, *known; /* (supports): what viscoelastic pads remember */
    double *modal, *load;                                         /* rows */
    double *offset; /* bays by which the window of an endless track has moved */
} rc_track_state;

typedef enum {
    RC_NOT_CONVERGED, /* the increments, or the contact forces */
    RC_MADE,
    RC_LOST /* a wheel has left the window, see window.h */
} rc_advance;

/* One step to given wheel positions, for any contact forces; twin of track_fmu/step_operator.py.
 * Matrices per contact force or per increment hold a column as one line of `stride` numbers. */
typedef struct {
    int made, linear;
    double step;
    double *start;    /* dynamic values at its beginning */
    double *position; /* (wheels), at its end */
    rc_rail_point *wheels;
    rc_active active;
    const rc_exponential *exponential;
    double *contact;          /* (wheels) rows: modal displacement at the wheels */
    const double **contacts;  /* the same, one by one */
    double *free;             /* row: modal state without forces at the end */
    double *free_contact, *contact_contact; /* (wheels), (wheels, wheels) */
    double *free_active, *free_rate;        /* (stride) */
    double *active_contact, *rate_contact;  /* (wheels, stride): per contact force */
    double *contact_active;                 /* (wheels, stride): per increment */
    double *free_acceleration, *acceleration_contact; /* likewise, if a law asks for them */
    rc_tangents tangents;                   /* (stride): at the step's start, or taken last */
    double *correction; /* (stride, stride): inverse Jacobian of the increments' equation */
    double *increment;                      /* (stride), of the step applied last */
} rc_operator;

typedef struct {
    rc_basis basis;
    rc_laws laws;
    int endless;
    int linear; /* of the last step */
    size_t per_wheel, room; /* room: most active supports, filled up */
    double initial_speed;
    double *gauge_position;         /* (gauges) */
    rc_rail_point *points;          /* (wheels) */
    rc_exponentials exponentials;
    rc_operator operator_;
    rc_active active;
    size_t *first, *pivot;
    double *duals;               /* rows, see operator.c */
    const double **dual_rows;
    double *products, *scratch, *small; /* see the functions that use them */
    double *row, *other_row;
    double *inside; /* (wheels): positions from the beginning of the window */
    double *field;  /* see window_shift.c */
    double lost, lost_window; /* m; see rc_find_wheels */
    double *before;              /* dynamic values at the beginning of a divided step */
    double *after, *change;      /* dynamic values, where derivatives are worked out */
    double *position, *force;    /* (wheels): within a divided step */
    double *moved, *pressed;     /* (wheels): inputs beside those of the last step */
    double last_step;
    void *memory;
} rc_track;

rc_track_state rc_view_state(const rc_basis *basis, double *values);
size_t rc_count_state(const rc_basis *basis);

/* Claims what the parameters ask for. */
rc_status rc_claim_track(rc_model *model, rc_track *track);
void rc_release_track(rc_track *track);

/* Chooses the active supports for wheels at these positions. */
void rc_choose_supports(rc_track *track, const rc_track_state *state, const double *positions);

/* Nonlinear static equilibrium under wheels at track->points; twin of static_start.py. 0 if it is
 * not found. */
int rc_static_start(rc_track *track, rc_track_state *state, const double *forces);

/* Makes the operator of a step to wheels within the window, unless it is made already. */
void rc_prepare_operator(rc_track *track, const double *dynamic, double step, int linear,
                         const double *positions);

/* The Jacobian of the increments' equation at given forces and active increments, those of the
 * step's start if they are NULL: there it depends on nothing but the state, so that a repeated step
 * is the same bit for bit; for stiff laws it is worked out before every use. */
void rc_linearise_increments(rc_track *track, const double *forces, const double *increment);

/* Leaves in the operator the increments that are consistent with the motion they cause, by
 * Newton's iteration with that Jacobian; 0 if it does not converge. */
int rc_solve_increments(rc_track *track, const double *forces);

/* Notes what viscoelastic pads remember of the end of the step under given forces and the operator's
 * increments. */
void rc_remember_pads(rc_track *track, const double *forces, rc_track_state *state);

/* Increments that the motion under given forces and increments asks for. */
void rc_demand_increments(rc_track *track, const double *forces, const double *increment,
                          double *demanded);

/* What the contact force of a wheel, by one newton more, adds to the increments asked for. */
void rc_demand_by_force(const rc_track *track, const rc_tangents *tangents, size_t wheel,
                        double *demand);

/* What a change of the forces changes in the increments found last; there must be room for the
 * Jacobian behind `change`, which track->products has. 0 if it is singular. */
int rc_change_increments(rc_track *track, const double *forces, const double *force_change,
                         double *change);

/* Makes modal loads and displacements follow positions and forces that have jumped; the wheels are
 * at track->points. */
void rc_load_track(rc_track *track, rc_track_state *state);

/* Rail displacements under the wheels at the end of the step under given forces and increments. */
void rc_press_rail(const rc_track *track, const double *forces, const double *increment,
                   double *displacement);

/* Moves the state to the end of the step under given forces and the operator's increments. */
void rc_move_track(rc_track *track, rc_track_state *state, const double *forces);

/* The same with increments that agree with the forces; 0 if they do not converge. */
int rc_apply_operator(rc_track *track, rc_track_state *state, const double *forces);

/* Its derivative: what a change of the contact forces changes in the state. */
int rc_differentiate_operator(rc_track *track, const double *force_change, rc_track_state *change);

/* Whether a state is one of numbers; with a step too short for its inputs it is not. */
int rc_is_finite(const rc_basis *basis, const rc_track_state *state);

/* Into how many parts a step is divided. */
double rc_count_parts(double step);

/* One step to positions and forces, divided where it is long; the dynamic values are as before
 * unless it is made. */
rc_advance rc_advance_track(rc_track *track, double *dynamic, double step, const double *positions,
                     const double *forces);

/* See rc_class. */
rc_status rc_derive_track(rc_model *model, const double *seed, double *changes);

#endif
