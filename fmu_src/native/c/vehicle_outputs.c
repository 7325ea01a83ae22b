/* Outputs of the vehicle, and how they change with the rail under it. */
#include <math.h>
#include <string.h>

#include "contact.h"
#include "vehicle.h"

#define DIFFERENCE 1e-8 /* m of rail displacement; far below a contact's compression */

static double compression(const rc_vehicle *own, const rc_vehicle_state *at, size_t wheel)
{
    const double leading = rc_leading_position(own, *at->start, *at->time);
    return at->displacement[wheel] - (at->rail[wheel] + rc_drop(own, wheel, leading));
}

void rc_read_vehicle(const rc_vehicle *own, double *dynamic, size_t group, double *values)
{
    const rc_vehicle_state at = rc_vehicle_view(own, dynamic);
    if (group >= BODIES) {
        rc_take_coordinates(own, dynamic, own->q, own->v);
        rc_read_bodies(&own->suspension, own->q, own->v, group - BODIES, values);
        return;
    }
    for (size_t i = 0; i < own->wheels; ++i)
        switch (group) {
        case POSITION:
            values[i] = rc_leading_position(own, *at.start, *at.time) - own->offsets[i];
            break;
        case CONTACT_FORCE:
            values[i] = rc_hertz_force(compression(own, &at, i), own->wheel.coefficient);
            break;
        case DISPLACEMENT:
            values[i] = at.displacement[i];
            break;
        case VELOCITY:
            values[i] = at.velocity[i];
            break;
        case GAP:
            values[i] = -compression(own, &at, i);
            break;
        default: /* IN_CONTACT */
            values[i] = compression(own, &at, i) > 0.0 ? 1.0 : 0.0;
        }
}

/* Of rigid masses, which do not know of each other: exact. */
static void derive_wheels(const rc_model *model, const double *seed, double *change)
{
    const rc_vehicle *own = model->own;
    const rc_vehicle_state from = rc_vehicle_view(own, own->before);
    const rc_vehicle_state at = rc_vehicle_view(own, model->dynamic);
    for (size_t i = 0; i < own->wheels; ++i) {
        const rc_way over = {.start = *from.start, .time = *from.time, .step = own->last_step,
                             .rail_start = own->linear ? from.rail[i] : at.rail[i],
                             .rail_end = at.rail[i],
                             .rise_start = own->linear ? 0.0 : seed[i], .rise_end = seed[i]};
        rc_wheel_motion moved = {0.0, 0.0};
        (void)rc_roll_wheel(own, i, &over,
                            (rc_wheel_motion){from.displacement[i], from.velocity[i]}, &moved);
        const double delta = compression(own, &at, i), closer = moved.displacement - seed[i];
        change[model->slots[CONTACT_FORCE] + i] =
            rc_hertz_stiffness(delta, own->wheel.coefficient) * closer;
        change[model->slots[DISPLACEMENT] + i] = moved.displacement;
        change[model->slots[VELOCITY] + i] = moved.velocity;
        change[model->slots[GAP] + i] = -closer;
    }
}

/* The last step again, with the rail displaced by a multiple of the seed. */
static void try_step(const rc_model *model, const double *seed, double size)
{
    const rc_vehicle *own = model->own;
    const rc_vehicle_state from = rc_vehicle_view(own, own->before);
    const rc_vehicle_state at = rc_vehicle_view(own, model->dynamic);
    const rc_vehicle_state to = rc_vehicle_view(own, own->trial);
    for (size_t i = 0; i < own->wheels; ++i)
        own->rail[i] = at.rail[i] + size * seed[i];
    rc_roll_suspended(own, own->before, own->trial, own->rail, *from.time, own->last_step);
    *to.start = *at.start;
    *to.time = *at.time;
}

/* Of the suspended vehicle: by central differences. */
static void derive_suspended(const rc_model *model, const double *seed, double *change)
{
    const rc_vehicle *own = model->own;
    double largest = 0.0;
    for (size_t i = 0; i < own->wheels; ++i)
        largest = fmax(largest, fabs(seed[i]));
    if (!(largest > 0.0))
        return;
    const double size = DIFFERENCE / largest;
    for (int sign = 1; sign >= -1; sign -= 2) {
        try_step(model, seed, sign * size);
        for (size_t g = CONTACT_FORCE; g < LINEAR_INPUTS; ++g) {
            if (g == IN_CONTACT)
                continue;
            rc_read_vehicle(own, own->trial, g, own->differences);
            for (size_t i = 0; i < model->groups[g].count; ++i)
                change[model->slots[g] + i] += sign * own->differences[i] / (2.0 * size);
        }
    }
}

rc_status rc_derive_vehicle(rc_model *model, const double *seed, double *change)
{
    const rc_vehicle *own = model->own;
    if (own->suspension.coupled)
        derive_suspended(model, seed, change);
    else
        derive_wheels(model, seed, change);
    return RC_OK;
}
