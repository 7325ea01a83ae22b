/* Force increments at the end of a step, consistent with the motion that they cause. */
#include <math.h>
#include <string.h>

#include "dense.h"
#include "track.h"

#define RELATIVE_TOLERANCE 1e-13
#define ABSOLUTE_TOLERANCE 1e-9 /* N */
#define MOST_SWEEPS 30
#define MOST_HALVINGS 6

/* A quantity of the components at the end of the step: free, per contact force, per increment. */
static void follow(const rc_track *track, const double *free, const double *by_force,
                   const double *by_increment, const double *forces, const double *increment,
                   double *value)
{
    const rc_active *active = &track->operator_.active;
    memcpy(value, free, active->stride * sizeof(double));
    rc_add_transformed(value, 1.0, by_force, forces, track->basis.wheels, active->stride);
    rc_add_transformed(value, -1.0, by_increment, increment, active->count, active->stride);
}

/* The motion of the components under given forces and increments, kept at the beginning of
 * track->small. */
#define MOTION_ROWS 3
static rc_motion move(const rc_track *track, const double *forces, const double *increment)
{
    const rc_operator *op = &track->operator_;
    const rc_exponential *step = op->exponential;
    double *deformation = track->small, *rate = deformation + op->active.stride;
    double *acceleration = track->laws.inertial ? rate + op->active.stride : NULL;
    follow(track, op->free_active, op->active_contact, step->coupling, forces, increment,
           deformation);
    follow(track, op->free_rate, op->rate_contact, step->rate_coupling, forces, increment, rate);
    if (acceleration != NULL)
        follow(track, op->free_acceleration, op->acceleration_contact,
               step->acceleration_coupling, forces, increment, acceleration);
    return (rc_motion){deformation, rate, acceleration};
}

/* The same without rates: the tangents of the plain law hold at rest. */
static rc_motion stop(const rc_track *track, const double *forces, const double *increment)
{
    const rc_operator *op = &track->operator_;
    double *deformation = track->small, *rate = deformation + op->active.stride;
    follow(track, op->free_active, op->active_contact, op->exponential->coupling, forces,
           increment, deformation);
    memset(rate, 0, op->active.stride * sizeof(double));
    return (rc_motion){deformation, rate, NULL};
}

static void gather(const rc_active *active, const double *all, double *chosen)
{
    for (size_t a = 0; a < active->count; ++a)
        chosen[a] = all[active->number[a]];
}

/* (1 + k A + d R + m B), whose inverse, transposed, is left in `matrix`. */
static int invert_jacobian(rc_track *track, const rc_tangents *tangents, double *matrix)
{
    const rc_operator *op = &track->operator_;
    const size_t count = op->active.count, stride = op->active.stride;
    const double *coupling = op->exponential->coupling, *rates = op->exponential->rate_coupling;
    const double *accelerations = op->exponential->acceleration_coupling;
    memset(matrix, 0, count * stride * sizeof(double));
    for (size_t b = 0; b < count; ++b) { /* by columns: the transposed matrix by rows */
        for (size_t a = 0; a < count; ++a)
            matrix[b * stride + a] = tangents->stiffness[a] * coupling[b * stride + a] +
                                     tangents->damping[a] * rates[b * stride + a];
        for (size_t a = 0; a < count && track->laws.inertial; ++a)
            matrix[b * stride + a] += tangents->mass[a] * accelerations[b * stride + a];
        matrix[b * stride + b] += 1.0;
    }
    return rc_invert(matrix, count, stride, track->pivot);
}

void rc_demand_by_force(const rc_track *track, const rc_tangents *tangents, size_t wheel,
                        double *demand)
{
    const rc_operator *op = &track->operator_;
    const size_t line = wheel * op->active.stride;
    const double *pressed = op->active_contact + line, *rate = op->rate_contact + line;
    for (size_t a = 0; a < op->active.count; ++a)
        demand[a] = tangents->stiffness[a] * pressed[a] + tangents->damping[a] * rate[a];
    for (size_t a = 0; a < op->active.count && track->laws.inertial; ++a)
        demand[a] += tangents->mass[a] * op->acceleration_contact[line + a];
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
    double *first = track->small + MOTION_ROWS * stride;
    const rc_pad_memory memory = remembered(track);
    if (increment == NULL) {
        gather(&op->active, rc_view_state(&track->basis, op->start).increment, first);
        increment = first;
    }
    const rc_motion motion = rc_is_stiff(&track->laws) ? move(track, forces, increment)
                                                       : stop(track, forces, increment);
    rc_law_tangents(&track->laws, &op->active, &memory, &motion, 0, &op->tangents);
    if (!invert_jacobian(track, &op->tangents, op->correction))
        for (size_t k = 0; k < count * stride; ++k)
            op->correction[k] = NAN; /* the sweeps will not converge, which is told */
}

void rc_demand_increments(rc_track *track, const double *forces, const double *increment,
                          double *demanded)
{
    const rc_motion motion = move(track, forces, increment);
    const rc_pad_memory memory = remembered(track);
    rc_law_forces(&track->laws, &track->operator_.active, &memory, &motion, demanded);
}

void rc_remember_pads(rc_track *track, const double *forces, rc_track_state *state)
{
    const rc_operator *op = &track->operator_;
    const rc_pad_memory memory = remembered(track);
    const rc_motion motion = move(track, forces, op->increment);
    memset(state->branch_force, 0, 3 * track->basis.supports * sizeof(double));
    rc_law_memories(&track->laws, &op->active, &memory, &motion, state->branch_force,
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
    double *increment = op->increment, *miss = track->small + (MOTION_ROWS + 1) * stride;
    double *change = miss + stride, *new = change + stride, *new_miss = new + stride;
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
    double *change = track->small + MOTION_ROWS * stride, *defect = change + stride;
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
    double *own = track->small + MOTION_ROWS * stride;
    const rc_tangents tangents = {own, own + stride, own + 2 * stride};
    double *by_force = own + 3 * stride, *demand = own + 4 * stride, *matrix = change + stride;
    const rc_motion motion = move(track, forces, op->increment);
    const rc_pad_memory memory = remembered(track);
    rc_law_tangents(&track->laws, &op->active, &memory, &motion, 1, &tangents);
    memset(demand, 0, count * sizeof(double));
    for (size_t j = 0; j < wheels; ++j) {
        rc_demand_by_force(track, &tangents, j, by_force);
        for (size_t a = 0; a < count; ++a)
            demand[a] += by_force[a] * force_change[j];
    }
    if (!invert_jacobian(track, &tangents, matrix))
        return 0;
    rc_transform(change, matrix, demand, count, stride);
    return 1;
}
