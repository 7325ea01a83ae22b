/* The suspended vehicle on the rail; twin of vehicle_fmu/suspended_vehicle.py. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "contact.h"
#include "equilibrium.h"
#include "vehicle.h"

typedef struct {
    const rc_vehicle *own;
    const rc_vehicle_state *from;
    const double *rail;
    double time, step;
    size_t halves, known; /* half substeps of the step; that for which the levels are known */
} rolling;

static void find_levels(rolling *of, size_t k)
{
    const rc_vehicle *own = of->own;
    if (of->known == k)
        return;
    for (size_t i = 0; i < own->wheels; ++i) {
        const rc_way over = {.start = *of->from->start, .time = of->time, .step = of->step,
                             .rail_start = own->linear ? of->from->rail[i] : of->rail[i],
                             .rail_end = of->rail[i]};
        own->level[i] = rc_level(own, i, &over, k, of->halves);
    }
    of->known = k;
}

static void press(void *of, size_t k, const double *displacement, double *push)
{
    rolling *over = of;
    const rc_vehicle *own = over->own;
    find_levels(over, k);
    for (size_t i = 0; i < own->wheels; ++i) {
        const double delta = (over->from->origin[i] + displacement[i]) - own->level[i];
        push[i] = own->wheel.load - rc_hertz_force(delta, own->wheel.coefficient);
    }
}

void rc_take_coordinates(const rc_vehicle *own, const double *values, double *q, double *v)
{
    const size_t n = own->wheels, above = own->suspension.coordinates - n;
    const double *displacement = values + 2, *velocity = displacement + n;
    const double *origin = displacement + 3 * n;
    for (size_t i = 0; i < n; ++i) {
        q[i] = displacement[i] - origin[i];
        v[i] = velocity[i];
    }
    memcpy(q + n, origin + n, above * sizeof(double));
    memcpy(v + n, origin + n + above, above * sizeof(double));
}

typedef struct {
    const rc_vehicle *own;
    double mean;
} standing;

static rc_pressed tread_on(void *of, size_t wheel, double displacement)
{
    const standing *on = of;
    const rc_wheel *kind = &on->own->wheel;
    const double delta = fmax(on->mean + displacement - on->own->level[wheel], 0.0);
    const double root = kind->coefficient * sqrt(delta);
    return (rc_pressed){kind->load - root * delta, 1.5 * root};
}

int rc_settle_vehicle(const rc_vehicle *own, const rc_vehicle_state *at)
{
    const size_t n = own->wheels, above = (own->suspension.coordinates - n) * sizeof(double);
    standing on = {own, 0.0};
    for (size_t i = 0; i < n; ++i)
        on.mean += at->displacement[i];
    on.mean /= (double)n;
    for (size_t i = 0; i < n; ++i) {
        own->differences[i] = at->displacement[i] - on.mean;
        own->rail[i] = rc_rate(own, i, *at->start, RC_SWAY);
    }
    const rc_settling settling = {&own->suspension, own->wheel.load, tread_on, &on};
    rc_follow(&own->suspension, own->differences, own->q);
    rc_follow(&own->suspension, own->rail, own->v);
    if (!rc_settle(&settling, own->q))
        return 0;
    for (size_t i = 0; i < n; ++i) {
        at->origin[i] = on.mean;
        at->displacement[i] = on.mean + own->q[i];
    }
    memcpy(at->above, own->q + n, above);
    memcpy(at->above_rate, own->v + n, above);
    return 1;
}

void rc_roll_suspended(const rc_vehicle *own, double *from, double *to, const double *rail,
                       double time, double step)
{
    const rc_vehicle_state at = rc_vehicle_view(own, from), end = rc_vehicle_view(own, to);
    const size_t n = own->wheels, above = (own->suspension.coordinates - n) * sizeof(double);
    const size_t substeps = rc_substeps(step, own->substep);
    rolling over = {.own = own, .from = &at, .rail = rail, .time = time, .step = step,
                    .halves = 2 * substeps, .known = SIZE_MAX};
    rc_take_coordinates(own, from, own->q, own->v);
    rc_advance(&own->suspension, own->q, own->v, step, substeps, press, &over);
    for (size_t i = 0; i < n; ++i) {
        end.displacement[i] = at.origin[i] + own->q[i];
        end.velocity[i] = own->v[i];
        end.origin[i] = at.origin[i];
        end.rail[i] = rail[i];
    }
    memcpy(end.above, own->q + n, above);
    memcpy(end.above_rate, own->v + n, above);
}
