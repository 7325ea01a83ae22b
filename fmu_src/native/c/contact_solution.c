#include "contact_solution.h"

#include <math.h>
#include <string.h>

#include "contact.h"
#include "dense.h"

#define RELATIVE_TOLERANCE 1e-13
#define ABSOLUTE_TOLERANCE 1e-8 /* N */
#define STIFFNESS 1e9 /* N/m, of a loaded contact; it makes compressions comparable with forces */
#define MOST_ITERATIONS 60
#define MOST_HALVINGS 6

static double dot(const double *a, const double *b, size_t count)
{
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k)
        sum += a[k] * b[k];
    return sum;
}

/* How increments and rail displacements answer to forces, with the tangents at the step's start, or
 * where they were taken last. */
static void find_answer(const rc_track *track, const rc_contact_work *work)
{
    const rc_operator *op = &track->operator_;
    const size_t wheels = track->basis.wheels, count = op->active.count, stride = op->active.stride;
    for (size_t j = 0; j < wheels; ++j) {
        rc_demand_by_force(track, &op->tangents, j, work->demand);
        rc_transform(work->response + j * stride, op->correction, work->demand, count, stride);
    }
    for (size_t i = 0; i < wheels; ++i) {
        const double *line = op->contact_active + i * stride;
        for (size_t b = 0; b < count; ++b) /* a line of `correction` is a column of the inverse */
            work->relief[i * stride + b] = dot(line, op->correction + b * stride, count);
        for (size_t j = 0; j < wheels; ++j)
            work->displacement[i * wheels + j] =
                op->contact_contact[i * wheels + j] -
                dot(line, work->response + j * stride, count);
    }
}

/* One measure of compressions [m] and increments [N]; not finite if one of them is not. */
static double measure(const double *compression, size_t wheels, const double *increment,
                      size_t count)
{
    return STIFFNESS * rc_largest(compression, wheels) + rc_largest(increment, count);
}

/* Fills in what follows from the compressions and increments of a trial. */
static void complete(rc_track *track, rc_contact_trial *trial, double coefficient,
                     const double *level)
{
    const size_t wheels = track->basis.wheels, count = track->operator_.active.count;
    for (size_t i = 0; i < wheels; ++i)
        trial->force[i] = rc_hertz_force(trial->compression[i], coefficient);
    rc_press_rail(track, trial->force, trial->increment, trial->miss);
    for (size_t i = 0; i < wheels; ++i)
        trial->miss[i] = level[i] - trial->miss[i] - trial->compression[i];
    rc_demand_increments(track, trial->force, trial->increment, trial->increment_miss);
    for (size_t a = 0; a < count; ++a)
        trial->increment_miss[a] -= trial->increment[a];
    trial->size = measure(trial->miss, wheels, trial->increment_miss, count);
}

/* Newton's change of compressions [m] and increments [N]; 0 if there is none. */
static int find_change(const rc_track *track, const rc_contact_work *work, double coefficient,
                       const rc_contact_trial *trial)
{
    const rc_operator *op = &track->operator_;
    const size_t wheels = track->basis.wheels, count = op->active.count, stride = op->active.stride;
    const size_t line = rc_stride(wheels);
    double *stiffness = work->push;
    memset(work->matrix, 0, wheels * line * sizeof(double));
    for (size_t j = 0; j < wheels; ++j)
        stiffness[j] = rc_hertz_stiffness(trial->compression[j], coefficient);
    for (size_t i = 0; i < wheels; ++i) {
        for (size_t j = 0; j < wheels; ++j)
            work->matrix[i * line + j] = work->displacement[i * wheels + j] * stiffness[j];
        work->matrix[i * line + i] += 1.0;
    }
    if (!rc_invert(work->matrix, wheels, line, work->pivot))
        return 0;
    memset(work->change, 0, wheels * sizeof(double));
    for (size_t j = 0; j < wheels; ++j) {
        const double wanted =
            trial->miss[j] + dot(work->relief + j * stride, trial->increment_miss, count);
        for (size_t i = 0; i < wheels; ++i)
            work->change[i] += work->matrix[i * line + j] * wanted;
    }
    for (size_t j = 0; j < wheels; ++j)
        work->push[j] = stiffness[j] * work->change[j];
    rc_transform(work->increment_change, op->correction, trial->increment_miss, count, stride);
    rc_add_transformed(work->increment_change, 1.0, work->response, work->push, wheels, stride);
    return 1;
}

/* The first of the trials on the way of Newton's change that misses no more than `from`. */
static void search(rc_track *track, const rc_contact_work *work, const rc_contact_trial *from,
                   rc_contact_trial *to, double coefficient, const double *level)
{
    const size_t wheels = track->basis.wheels, count = track->operator_.active.count;
    double share = 1.0;
    for (int halvings = 0; halvings < MOST_HALVINGS; ++halvings, share *= 0.5) {
        for (size_t i = 0; i < wheels; ++i)
            to->compression[i] = from->compression[i] + share * work->change[i];
        for (size_t a = 0; a < count; ++a)
            to->increment[a] = from->increment[a] + share * work->increment_change[a];
        complete(track, to, coefficient, level);
        if (to->size <= from->size)
            return;
    }
}

/* Whether the last two trials agree. */
static int has_settled(const rc_track *track, const rc_contact_work *work,
                       const rc_contact_trial *from, const rc_contact_trial *to)
{
    const size_t wheels = track->basis.wheels, count = track->operator_.active.count;
    for (size_t i = 0; i < wheels; ++i)
        work->change[i] = to->compression[i] - from->compression[i];
    for (size_t a = 0; a < count; ++a)
        work->increment_change[a] = to->increment[a] - from->increment[a];
    const double moved = measure(work->change, wheels, work->increment_change, count);
    const double scale = rc_largest(to->force, wheels) + rc_largest(to->increment, count);
    return moved <= RELATIVE_TOLERANCE * scale + ABSOLUTE_TOLERANCE;
}

int rc_solve_contact(rc_track *track, rc_contact_work *work, double coefficient,
                     const double *level, const double *compression)
{
    rc_operator *op = &track->operator_;
    rc_contact_trial *trial = &work->trials[0], *next = &work->trials[1];
    const rc_track_state start = rc_view_state(&track->basis, op->start);
    memcpy(trial->compression, compression, track->basis.wheels * sizeof(double));
    for (size_t a = 0; a < op->active.count; ++a)
        trial->increment[a] = start.increment[op->active.number[a]];
    if (!rc_is_stiff(&track->laws))
        find_answer(track, work);
    complete(track, trial, coefficient, level);
    for (int iteration = 0; iteration < MOST_ITERATIONS; ++iteration) {
        if (rc_is_stiff(&track->laws)) {
            rc_linearise_increments(track, trial->force, trial->increment);
            find_answer(track, work);
        }
        if (!find_change(track, work, coefficient, trial))
            return 0;
        search(track, work, trial, next, coefficient, level);
        if (!isfinite(next->size))
            return 0;
        const int settled = has_settled(track, work, trial, next);
        rc_contact_trial *last = trial;
        trial = next;
        next = last;
        if (settled) {
            memcpy(op->increment, trial->increment, op->active.count * sizeof(double));
            work->solution = trial;
            return 1;
        }
    }
    return 0;
}
