/* The suspended vehicle under given contact forces; twin of vehicle_fmu/suspended_masses.py. */
#include <math.h>
#include <string.h>

#include "equilibrium.h"
#include "masses.h"

#define DIFFERENCE 1e4 /* N; the motion is linear in the forces but where a stop is met */

typedef struct {
    const rc_masses *own;
    const rc_masses_state *at;
    const double *slope;
    double half; /* substep, s */
} line;

static void press(void *of, size_t k, const double *displacement, double *push)
{
    const line *along = of;
    (void)displacement; /* the forces are given */
    for (size_t i = 0; i < along->own->wheels; ++i)
        push[i] = along->own->load -
                  (along->at->force[i] + (double)k * along->half * along->slope[i]);
}

/* Coordinates and rates after a time in which the forces change at a given rate, in q and v. */
static void move_on(const rc_masses *own, const rc_masses_state *at, double duration,
                    const double *slope)
{
    const size_t n = own->wheels, above = (own->suspension.coordinates - n) * sizeof(double);
    memcpy(own->q, at->displacement, n * sizeof(double));
    memcpy(own->q + n, at->above, above);
    memcpy(own->v, at->velocity, n * sizeof(double));
    memcpy(own->v + n, at->above_rate, above);
    if (duration == 0.0)
        return;
    const size_t substeps = rc_substeps(duration, own->substep);
    line along = {.own = own, .at = at, .slope = slope,
                  .half = 0.5 * duration / (double)substeps};
    rc_advance(&own->suspension, own->q, own->v, duration, substeps, press, &along);
}

/* Takes over coordinates and rates at which the forces are known. */
static void put_known(const rc_masses *own, const rc_masses_state *at, const double *q,
                      const double *v)
{
    const size_t n = own->wheels, above = (own->suspension.coordinates - n) * sizeof(double);
    memcpy(at->displacement, q, n * sizeof(double));
    memcpy(at->above, q + n, above);
    memcpy(at->velocity, v, n * sizeof(double));
    memcpy(at->above_rate, v + n, above);
}

/* To where the forces are known to have become the given ones. */
static void follow(const rc_masses *own, const rc_masses_state *at, double duration,
                   const double *forces)
{
    if (duration > 0.0) {
        for (size_t i = 0; i < own->wheels; ++i)
            at->slope[i] = (forces[i] - at->force[i]) / duration;
        move_on(own, at, duration, at->slope);
        put_known(own, at, own->q, own->v);
    }
    memcpy(at->force, forces, own->wheels * sizeof(double));
}

/* Beyond that, on the last line. */
static void look_ahead(const rc_masses *own, const rc_masses_state *at)
{
    const size_t bytes = own->suspension.coordinates * sizeof(double);
    move_on(own, at, *at->passed, at->slope);
    memcpy(at->ahead, own->q, bytes);
    memcpy(at->ahead_rate, own->v, bytes);
}

int rc_settle_masses(const rc_masses *own, const rc_masses_state *at, const double *displacement,
                     const double *velocity)
{
    const size_t n = own->wheels;
    const rc_settling settling = {.suspension = &own->suspension, .load = own->load};
    double mean = 0.0;
    for (size_t i = 0; i < n; ++i)
        mean += displacement[i];
    mean /= (double)n;
    for (size_t i = 0; i < n; ++i)
        own->forces[i] = displacement[i] - mean;
    rc_follow(&own->suspension, own->forces, own->q);
    rc_follow(&own->suspension, velocity, own->v);
    if (!rc_settle(&settling, own->q))
        return 0;
    memcpy(own->v, at->velocity, n * sizeof(double));
    put_known(own, at, own->q, own->v);
    memcpy(at->ahead, own->q, own->suspension.coordinates * sizeof(double));
    memcpy(at->ahead_rate, own->v, own->suspension.coordinates * sizeof(double));
    memcpy(at->origin, own->q, n * sizeof(double));
    rc_press_at_rest(&own->suspension, own->q, own->load, at->load_change);
    return 1;
}

void rc_move_suspended(const rc_masses *own, const rc_masses_state *at, const double *forces,
                       double step, int linear)
{
    if (linear && *at->passed > 0.0) { /* where nobody tells what the forces have become */
        put_known(own, at, at->ahead, at->ahead_rate);
        for (size_t i = 0; i < own->wheels; ++i)
            at->force[i] += *at->passed * at->slope[i];
    }
    follow(own, at, linear ? step : *at->passed, forces);
    *at->passed = linear ? 0.0 : step;
    look_ahead(own, at);
}

void rc_jump_suspended(const rc_masses *own, const rc_masses_state *at, const double *forces)
{
    follow(own, at, *at->passed, forces);
    *at->passed = 0.0;
    look_ahead(own, at);
}

static void add_difference(const rc_model *model, const rc_masses_state *at, double factor,
                           double *change)
{
    const rc_masses *own = model->own;
    for (size_t i = 0; i < own->wheels; ++i) {
        change[model->slots[DISPLACEMENT] + i] += factor * at->ahead[i];
        change[model->slots[VELOCITY] + i] += factor * at->ahead_rate[i];
    }
    for (size_t g = BODIES; g < LINEAR_INPUTS; ++g) {
        rc_read_bodies(&own->suspension, at->ahead, at->ahead_rate, g - BODIES, own->differences);
        for (size_t i = 0; i < model->groups[g].count; ++i)
            change[model->slots[g] + i] += factor * own->differences[i];
    }
}

void rc_derive_suspended(rc_model *model, const double *seed, double *change)
{
    const rc_masses *own = model->own;
    const rc_masses_state now = rc_masses_view(own, model->dynamic);
    const rc_masses_state at = rc_masses_view(own, own->after);
    double largest = 0.0;
    for (size_t i = 0; i < own->wheels; ++i)
        largest = fmax(largest, fabs(seed[i]));
    if (!(largest > 0.0))
        return;
    const double size = DIFFERENCE / largest;
    for (int sign = 1; sign >= -1; sign -= 2) {
        memcpy(own->after, own->before, model->dynamic_count * sizeof(double));
        for (size_t i = 0; i < own->wheels; ++i)
            own->forces[i] = now.force[i] + sign * size * seed[i];
        rc_move_suspended(own, &at, own->forces, own->last_step, own->last_linear);
        add_difference(model, &at, sign / (2.0 * size), change);
    }
}
