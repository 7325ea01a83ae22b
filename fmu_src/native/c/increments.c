/* Force increments at the end of a step, consistent with the motion that they cause. */
#include <math.h>
#include <string.h>

#include "dense.h"
#include "track.h"

#define RELATIVE_TOLERANCE 1e-13
#define ABSOLUTE_TOLERANCE 1e-9 /* N */
#define MOST_SWEEPS 30
#define MOST_HALVINGS 6

/* Deformations at the end of the step under given forces and increments. */
static void deform(const rc_operator *op, const double *forces, size_t wheels,
                   const double *increment, double *deformation)
{
    const size_t stride = op->active.stride;
    memcpy(deformation, op->free_active, stride * sizeof(double));
    rc_add_transformed(deformation, 1.0, op->active_contact, forces, wheels, stride);
    rc_add_transformed(deformation, -1.0, op->exponential->coupling, increment, op->active.count,
                       stride);
}

static void change_rates(const rc_operator *op, const double *forces, size_t wheels,
                         const double *increment, double *rate)
{
    const size_t stride = op->active.stride;
    memcpy(rate, op->free_rate, stride * sizeof(double));
    rc_add_transformed(rate, 1.0, op->rate_contact, forces, wheels, stride);
    rc_add_transformed(rate, -1.0, op->exponential->rate_coupling, increment, op->active.count,
                       stride);
}

static void gather(const rc_active *active, const double *all, double *chosen)
{
    for (size_t a = 0; a < active->count; ++a)
        chosen[a] = all[active->number[a]];
}

/* (1 + k A + d R), whose inverse, transposed, is left in `matrix`. */
static int invert_jacobian(rc_track *track, const double *stiffness, const double *damping,
                           double *matrix)
{
    const rc_operator *op = &track->operator_;
    const size_t count = op->active.count, stride = op->active.stride;
    const double *coupling = op->exponential->coupling, *rates = op->exponential->rate_coupling;
    memset(matrix, 0, count * stride * sizeof(double));
    for (size_t b = 0; b < count; ++b) { /* by columns: the transposed matrix by rows */
        for (size_t a = 0; a < count; ++a)
            matrix[b * stride + a] = stiffness[a] * coupling[b * stride + a] +
                                     damping[a] * rates[b * stride + a];
        matrix[b * stride + b] += 1.0;
    }
    return rc_invert(matrix, count, stride, track->pivot);
}

/* What pads remember at the beginning of the step. */
static rc_pad_memory remembered(const rc_track *track)
{
    const rc_operator *op = &track->operator_;
    const rc_track_state start = rc_view_state(&track->basis, op->start);
    return (rc_pad_memory){op->step, start.branch_force, start.compression, start.known};
}

void rc_linearise_increments(rc_track *track, const double *forces, const double *increment)
{
    rc_operator *op = &track->operator_;
    const size_t count = op->active.count, stride = op->active.stride;
    const size_t wheels = track->basis.wheels;
    double *first = track->small, *deformation = first + stride, *rate = deformation + stride;
    const rc_pad_memory memory = remembered(track);
    if (increment == NULL) {
        gather(&op->active, rc_view_state(&track->basis, op->start).increment, first);
        increment = first;
    }
    deform(op, forces, wheels, increment, deformation);
    if (rc_is_stiff(&track->laws))
        change_rates(op, forces, wheels, increment, rate);
    rc_law_tangents(&track->laws, &op->active, &memory, deformation, rate, 0, op->stiffness,
                    op->damping);
    if (!invert_jacobian(track, op->stiffness, op->damping, op->correction))
        for (size_t k = 0; k < count * stride; ++k)
            op->correction[k] = NAN; /* the sweeps will not converge, which is told */
}

void rc_demand_increments(rc_track *track, const double *forces, const double *increment,
                          double *demanded)
{
    const rc_operator *op = &track->operator_;
    double *deformation = track->small, *rate = deformation + op->active.stride;
    deform(op, forces, track->basis.wheels, increment, deformation);
    change_rates(op, forces, track->basis.wheels, increment, rate);
    const rc_pad_memory memory = remembered(track);
    rc_law_forces(&track->laws, &op->active, &memory, deformation, rate, demanded);
}

void rc_remember_pads(rc_track *track, const double *forces, rc_track_state *state)
{
    const rc_operator *op = &track->operator_;
    double *deformation = track->small, *rate = deformation + op->active.stride;
    const rc_pad_memory memory = remembered(track);
    deform(op, forces, track->basis.wheels, op->increment, deformation);
    change_rates(op, forces, track->basis.wheels, op->increment, rate);
    memset(state->branch_force, 0, 3 * track->basis.supports * sizeof(double));
    rc_law_memories(&track->laws, &op->active, &memory, deformation, rate, state->branch_force,
                    state->compression, state->known);
}

/* What is missed where the increments are these; the largest of it. */
static double miss_increments(rc_track *track, const double *forces, const double *increment,
                              double *miss)
{
    const size_t count = track->operator_.active.count;
    rc_demand_increments(track, forces, increment, miss);
    for (size_t a = 0; a < count; ++a)
        miss[a] -= increment[a];
    return rc_largest(miss, count);
}

/* Newton's iteration with the Jacobian of every sweep, and shorter changes where they help. */
static int solve_stiffly(rc_track *track, const double *forces)
{
    rc_operator *op = &track->operator_;
    const size_t count = op->active.count, stride = op->active.stride;
    double *increment = op->increment, *miss = track->small + 3 * stride, *change = miss + stride;
    double *new = change + stride, *new_miss = new + stride;
    double size = miss_increments(track, forces, increment, miss);
    for (int sweep = 0; sweep < MOST_SWEEPS && isfinite(size); ++sweep) {
        rc_linearise_increments(track, forces, increment);
        rc_transform(change, op->correction, miss, count, stride);
        const double largest = rc_largest(change, count);
        if (!isfinite(largest))
            return 0;
        if (largest <= RELATIVE_TOLERANCE * rc_largest(increment, count) + ABSOLUTE_TOLERANCE) {
            for (size_t a = 0; a < count; ++a)
                increment[a] += change[a];
            return 1;
        }
        double share = 1.0, new_size = size;
        for (int halvings = 0; halvings < MOST_HALVINGS; ++halvings, share *= 0.5) {
            for (size_t a = 0; a < count; ++a)
                new[a] = increment[a] + share * change[a];
            new_size = miss_increments(track, forces, new, new_miss);
            if (new_size <= size)
                break;
        }
        memcpy(increment, new, count * sizeof(double));
        memcpy(miss, new_miss, count * sizeof(double));
        size = new_size;
    }
    return 0;
}

int rc_solve_increments(rc_track *track, const double *forces)
{
    rc_operator *op = &track->operator_;
    const size_t count = op->active.count, stride = op->active.stride;
    double *increment = op->increment;
    double *change = track->small + 2 * stride, *defect = change + stride;
    const rc_track_state start = rc_view_state(&track->basis, op->start);
    gather(&op->active, start.increment, increment);
    if (rc_is_stiff(&track->laws))
        return count == 0 || solve_stiffly(track, forces);
    for (int sweep = 0; count > 0; ++sweep) {
        rc_demand_increments(track, forces, increment, defect);
        for (size_t a = 0; a < count; ++a)
            defect[a] -= increment[a];
        rc_transform(change, op->correction, defect, count, stride);
        double largest = 0.0, largest_change = 0.0;
        int finite = 1;
        for (size_t a = 0; a < count; ++a) {
            increment[a] += change[a];
            finite &= isfinite(increment[a]) != 0;
            largest = fmax(largest, fabs(increment[a]));
            largest_change = fmax(largest_change, fabs(change[a]));
        }
        if (!finite || sweep == MOST_SWEEPS - 1)
            return finite && largest_change <= RELATIVE_TOLERANCE * largest + ABSOLUTE_TOLERANCE;
        if (largest_change <= RELATIVE_TOLERANCE * largest + ABSOLUTE_TOLERANCE)
            return 1;
    }
    return 1;
}

int rc_change_increments(rc_track *track, const double *forces, const double *force_change,
                         double *change)
{
    const rc_operator *op = &track->operator_;
    const size_t count = op->active.count, stride = op->active.stride;
    const size_t wheels = track->basis.wheels;
    double *deformation = track->small, *rate = deformation + stride;
    double *tangent = rate + stride, *damping = tangent + stride, *demand = damping + stride;
    double *matrix = change + stride;
    deform(op, forces, wheels, op->increment, deformation);
    change_rates(op, forces, wheels, op->increment, rate);
    const rc_pad_memory memory = remembered(track);
    rc_law_tangents(&track->laws, &op->active, &memory, deformation, rate, 1, tangent, damping);
    for (size_t a = 0; a < count; ++a) {
        demand[a] = 0.0;
        for (size_t j = 0; j < wheels; ++j)
            demand[a] += (tangent[a] * op->active_contact[j * stride + a] +
                          damping[a] * op->rate_contact[j * stride + a]) * force_change[j];
    }
    if (!invert_jacobian(track, tangent, damping, matrix))
        return 0;
    rc_transform(change, matrix, demand, count, stride);
    return 1;
}
