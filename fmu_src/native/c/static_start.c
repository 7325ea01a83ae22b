/* Nonlinear static equilibrium under standing or steadily moving wheels; twin of
 * track_fmu/static_start.py.
 *
 * The modal state follows the moving load quasi-steadily: q = -Q / lambda - Q' / lambda^2.
 */
#include <math.h>
#include <string.h>

#include "dense.h"
#include "rows.h"
#include "track.h"

#define MOST_SWEEPS 400
#define TOLERANCE 1e-12 /* relative change of the force increments */
#define SMALLEST_SHARE 1e-3 /* of a change */
#define OVERSHOOT 0.1       /* slope of the energy behind a change over the fall before it */
#define ROUNDING 1e-9       /* of a tangent stiffness */

typedef struct {
    double *increment, *rate_of_increment; /* the unknowns, (stride) each */
    double *deformation, *rate, *tangent, *defect, *change, *new_rate;
    double *start, *full; /* increments before the last change, and that change */
    double *still;        /* zeros */
    double *weight;       /* compliance times the last change */
    double *free_rate;    /* without that of the increments */
    double *residual;    /* (stride): deformation by the contact forces, without modes */
    double *compliance;  /* (stride, stride), residual flexibility included */
    double *flexibility; /* (stride, stride), residual only */
    double *matrix;
    double *contact_load, *contact_load_rate, *load_rate, *modal_rate; /* rows */
} equilibrium;

static equilibrium lay_out(rc_track *track)
{
    const size_t stride = track->active.stride, square = stride * stride;
    double *at = track->small, *rows = track->duals; /* of both there is enough */
    const size_t length = track->basis.length;
    return (equilibrium){.increment = at,
                         .rate_of_increment = at + stride,
                         .deformation = at + 2 * stride,
                         .rate = at + 3 * stride,
                         .tangent = at + 4 * stride,
                         .defect = at + 5 * stride,
                         .change = at + 6 * stride,
                         .new_rate = at + 7 * stride,
                         .residual = at + 8 * stride,
                         .start = at + 9 * stride,
                         .full = at + 10 * stride,
                         .free_rate = at + 11 * stride,
                         .still = at + 12 * stride,
                         .weight = at + 13 * stride,
                         .compliance = track->products,
                         .flexibility = track->products + square,
                         .matrix = track->products + 2 * square,
                         .contact_load = rows,
                         .contact_load_rate = rows + length,
                         .load_rate = rows + 2 * length,
                         .modal_rate = rows + 3 * length};
}

/* The loads of the wheels: all that does not change from sweep to sweep. */
static void load_track(rc_track *track, const equilibrium *at, const double *forces)
{
    const rc_basis *basis = &track->basis;
    const size_t stride = track->active.stride, half = basis->half;
    const double *row = track->row;
    memset(at->increment, 0, 9 * stride * sizeof(double));
    memset(at->still, 0, stride * sizeof(double));
    memset(at->contact_load, 0, 2 * basis->length * sizeof(double));
    for (size_t i = 0; i < basis->wheels; ++i) {
        const rc_rail_point *wheel = &track->points[i];
        const double rate = track->initial_speed * forces[i];
        rc_modes_at(basis, wheel, wheel->shape, track->row);
        rc_add_combination(at->contact_load, &row, &forces[i], 1, basis->length);
        rc_modes_at(basis, wheel, wheel->slope, track->row);
        rc_add_combination(at->contact_load_rate, &row, &rate, 1, basis->length);
        for (size_t a = 0; a < track->active.count; ++a)
            at->residual[a] +=
                rc_residual(basis, wheel, rc_component(basis, track->active.number[a])) * forces[i];
    }
    for (size_t n = 0; n < half; ++n) { /* minus w / lambda */
        track->row[n] = -basis->weight[n] * basis->inverses[n];
        track->row[half + n] = -basis->weight[n] * basis->inverses[half + n];
    }
    memset(at->flexibility, 0, stride * stride * sizeof(double));
    rc_add_residual(at->flexibility, &track->active, basis);
    rc_modal_coupling(at->compliance, &track->active, track->row, half, track->scratch);
    for (size_t k = 0; k < track->active.count * stride; ++k)
        at->compliance[k] += at->flexibility[k];
}

/* Modal state, load and deformations under the present increments. */
static void deform(rc_track *track, const equilibrium *at, rc_track_state *state)
{
    const rc_basis *basis = &track->basis;
    const rc_active *active = &track->active;
    const size_t length = basis->length, half = basis->half, count = active->count;
    double *opposed = at->change; /* free until the next change is known */
    for (size_t a = 0; a < count; ++a)
        opposed[a] = -at->increment[a];
    memcpy(state->load, at->contact_load, length * sizeof(double));
    rc_add_combination(state->load, active->rows, opposed, count, length);
    for (size_t a = 0; a < count; ++a)
        opposed[a] = -at->rate_of_increment[a];
    memcpy(at->load_rate, at->contact_load_rate, length * sizeof(double));
    rc_add_combination(at->load_rate, active->rows, opposed, count, length);
    /* -(Q + Q' / lambda) / lambda */
    rc_multiply(at->modal_rate, basis->inverses, at->load_rate, half);
    for (size_t k = 0; k < length; ++k)
        track->row[k] = -(state->load[k] + at->modal_rate[k]);
    rc_multiply(state->modal, basis->inverses, track->row, half);
    /* lambda q + Q */
    rc_multiply(at->modal_rate, basis->eigenvalues, state->modal, half);
    for (size_t k = 0; k < length; ++k)
        at->modal_rate[k] += state->load[k];
    const double *rows[2] = {track->row, track->other_row};
    rc_multiply_dual(track->row, track->scratch, state->modal, half);
    rc_multiply_dual(track->other_row, track->scratch, at->modal_rate, half);
    for (size_t a = 0; a < count; ++a) {
        double both[2];
        rc_products(&active->rows[a], 1, rows, 2, length, both, 2);
        at->deformation[a] = both[0] + at->residual[a];
        at->rate[a] = both[1];
    }
    rc_add_transformed(at->deformation, -1.0, at->flexibility, at->increment, count,
                       active->stride);
}

static const rc_pad_memory AT_REST = {0.0, NULL, NULL, NULL};

/* How much of the last change was taken, and how the energy fell before it: along a change d of the
 * increments its slope is -(C d) . miss, with the compliance C. */
typedef struct {
    double share, fall;
    int last; /* whether the rates of the increments are those of the equilibrium */
} search;

static double dot(const double *a, const double *b, size_t count)
{
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k)
        sum += a[k] * b[k];
    return sum;
}

static void begin_search(const equilibrium *at, search *way, size_t count, size_t stride)
{
    memcpy(at->start, at->increment, count * sizeof(double));
    memcpy(at->full, at->change, count * sizeof(double));
    way->share = 1.0;
    rc_transform(at->weight, at->compliance, at->full, count, stride); /* it is symmetric */
    way->fall = dot(at->weight, at->defect, count);
}

/* Whether the last change led uphill, as where gaps close; then half of it is taken. */
static int is_too_far(const equilibrium *at, search *way, size_t count)
{
    if (!(way->share > SMALLEST_SHARE &&
          dot(at->weight, at->defect, count) < -OVERSHOOT * way->fall))
        return 0;
    way->share *= 0.5;
    for (size_t a = 0; a < count; ++a)
        at->increment[a] = at->start[a] + way->share * at->full[a];
    return 1;
}

/* Whether the load on a component falls with its displacement: there are other equilibria then. */
static int falls(rc_track *track, const equilibrium *at)
{
    const rc_laws *laws = &track->laws;
    const size_t count = track->active.count;
    const rc_motion motion = {at->deformation, at->still, NULL};
    const rc_tangents tangents = {at->tangent, at->change, NULL};
    rc_law_tangents(laws, &track->active, &AT_REST, &motion, 0, &tangents);
    for (size_t a = 0; a < count; ++a) {
        const double linear = track->active.number[a] < laws->supports ? laws->ballast_stiffness
                                                                       : laws->pad_stiffness;
        if (at->tangent[a] + linear < -ROUNDING * linear)
            return 1;
    }
    return 0;
}

/* One sweep of Newton's iteration; 1 if it changed next to nothing, -1 if it failed. */
static int sweep(rc_track *track, const equilibrium *at, search *way)
{
    const size_t count = track->active.count, stride = track->active.stride;
    memset(at->matrix, 0, count * stride * sizeof(double));
    /* dampers of stiff laws bear nothing, and the rates of their increments are found once: where
     * gaps are about to close they would switch for ever */
    const int stiff = rc_is_stiff(&track->laws);
    const rc_motion motion = {at->deformation, stiff ? at->still : at->rate, NULL};
    const rc_tangents tangents = {at->tangent, at->change, NULL};
    rc_law_forces(&track->laws, &track->active, &AT_REST, &motion, at->defect);
    for (size_t a = 0; a < count; ++a)
        at->defect[a] -= at->increment[a];
    if (stiff && is_too_far(at, way, count))
        return 0;
    rc_law_tangents(&track->laws, &track->active, &AT_REST, &motion, 0, &tangents);
    for (size_t b = 0; b < count; ++b) { /* transposed, see rc_transform */
        for (size_t a = 0; a < count; ++a)
            at->matrix[b * stride + a] = at->tangent[a] * at->compliance[b * stride + a];
        at->matrix[b * stride + b] += 1.0;
    }
    if (!rc_invert(at->matrix, count, stride, track->pivot))
        return -1;
    rc_transform(at->change, at->matrix, at->defect, count, stride);
    begin_search(at, way, count, stride);
    /* the rate with the present increment rate taken out, then solved for both together */
    memcpy(at->free_rate, at->rate, stride * sizeof(double));
    rc_add_transformed(at->free_rate, 1.0, at->compliance, at->rate_of_increment, count, stride);
    rc_add_transformed(at->free_rate, -1.0, at->flexibility, at->rate_of_increment, count, stride);
    for (size_t a = 0; a < count; ++a)
        at->defect[a] = at->tangent[a] * at->free_rate[a];
    rc_transform(at->new_rate, at->matrix, at->defect, count, stride);
    for (size_t a = 0; a < count; ++a) {
        at->defect[a] = at->new_rate[a] - at->rate_of_increment[a];
        at->increment[a] += at->change[a];
    }
    const double scale = TOLERANCE * rc_largest(at->increment, count);
    const int found = rc_largest(at->change, count) <= scale;
    if (!stiff || found)
        memcpy(at->rate_of_increment, at->new_rate, count * sizeof(double));
    if (stiff) {
        const int done = found && way->last;
        if (found)
            *way = (search){0.0, 0.0, 1};
        return isfinite(scale) ? done : -1;
    }
    const double rate_scale = TOLERANCE * rc_largest(at->rate_of_increment, count) + scale;
    if (!isfinite(rate_scale))
        return -1;
    return found && rc_largest(at->defect, count) <= rate_scale;
}

/* Displacements of the rail under the wheels. */
static void press_contacts(rc_track *track, const equilibrium *at, const double *forces,
                           rc_track_state *state)
{
    const rc_basis *basis = &track->basis;
    rc_multiply_dual(track->other_row, track->scratch, state->modal, basis->half);
    for (size_t i = 0; i < basis->wheels; ++i) {
        const rc_rail_point *wheel = &track->points[i];
        rc_modes_at(basis, wheel, wheel->shape, track->row);
        double sum = rc_product(track->row, track->other_row, basis->length);
        for (size_t j = 0; j < basis->wheels; ++j)
            sum += rc_residual_between(basis, wheel, wheel->shape, &track->points[j],
                                       track->points[j].shape) * forces[j];
        for (size_t a = 0; a < track->active.count; ++a)
            sum -= rc_residual(basis, wheel, rc_component(basis, track->active.number[a])) *
                   at->increment[a];
        state->displacement[i] = sum;
    }
}

int rc_static_start(rc_track *track, rc_track_state *state, const double *forces)
{
    const rc_basis *basis = &track->basis;
    const equilibrium at = lay_out(track);
    load_track(track, &at, forces);
    /* the weight as a complex row, for duals: scratch is free again after load_track */
    memcpy(track->scratch, basis->weight, basis->half * sizeof(double));
    memset(track->scratch + basis->half, 0, basis->half * sizeof(double));
    search way = {0.0, 0.0, 0};
    for (int done = 0, left = MOST_SWEEPS; done != 1; --left) {
        if (left == 0 || done == -1)
            return 0;
        deform(track, &at, state);
        done = track->active.count == 0 ? 1 : sweep(track, &at, &way);
    }
    if (falls(track, &at))
        return 0;
    /* and their rates, and what pads remember */
    memset(state->increment, 0, 7 * basis->supports * sizeof(double));
    const rc_motion motion = {at.deformation, at.still, NULL};
    if (track->laws.pad == RC_VISCOELASTIC)
        rc_law_memories(&track->laws, &track->active, &AT_REST, &motion, state->branch_force,
                        state->compression, state->known);
    for (size_t a = 0; a < track->active.count; ++a) {
        state->increment[track->active.number[a]] = at.increment[a];
        state->increment_rate[track->active.number[a]] = at.rate_of_increment[a];
    }
    press_contacts(track, &at, forces, state);
    for (size_t i = 0; i < basis->wheels; ++i) {
        state->force[i] = forces[i];
        state->force_rate[i] = 0.0;
        state->speed[i] = track->initial_speed;
    }
    return 1;
}
