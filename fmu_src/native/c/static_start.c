/* Nonlinear static equilibrium under standing or steadily moving wheels; twin of
 * track_fmu/static_start.py. */
#include <math.h>
#include <string.h>

#include "dense.h"
#include "quasi_static.h"

#define MOST_SWEEPS 400
#define TOLERANCE 1e-12 /* relative change of the force increments */
#define SMALLEST_SHARE 1e-3 /* of a change */
#define OVERSHOOT 0.1       /* slope of the energy behind a change over the fall before it */
#define ROUNDING 1e-9       /* of a tangent stiffness */

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

static void begin_search(const rc_quasi_static *at, search *way, size_t count, size_t stride)
{
    memcpy(at->start, at->increment, count * sizeof(double));
    memcpy(at->full, at->change, count * sizeof(double));
    way->share = 1.0;
    rc_transform(at->weight, at->compliance, at->full, count, stride); /* it is symmetric */
    way->fall = dot(at->weight, at->defect, count);
}

/* Whether the last change led uphill, as where gaps close; then half of it is taken. */
static int is_too_far(const rc_quasi_static *at, search *way, size_t count)
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
static int falls(rc_track *track, const rc_quasi_static *at)
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
static int sweep(rc_track *track, const rc_quasi_static *at, search *way)
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

int rc_static_start(rc_track *track, rc_track_state *state, const double *forces)
{
    const rc_basis *basis = &track->basis;
    const rc_quasi_static at = rc_lay_out_quasi_static(track);
    rc_load_quasi_statically(track, &at, forces);
    /* the weight as a complex row, for duals: scratch is free again after that */
    memcpy(track->scratch, basis->weight, basis->half * sizeof(double));
    memset(track->scratch + basis->half, 0, basis->half * sizeof(double));
    search way = {0.0, 0.0, 0};
    for (int done = 0, left = MOST_SWEEPS; done != 1; --left) {
        if (left == 0 || done == -1)
            return 0;
        rc_deform_quasi_statically(track, &at, state);
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
    rc_find_displacements(track, &at, forces, state);
    for (size_t i = 0; i < basis->wheels; ++i) {
        state->force[i] = forces[i];
        state->force_rate[i] = 0.0;
        state->speed[i] = track->initial_speed;
    }
    return 1;
}
