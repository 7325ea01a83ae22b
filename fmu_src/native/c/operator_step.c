/* The end of a step from its operator, for given contact forces; and its derivative. */
#include <string.h>

#include "rows.h"
#include "track.h"

/* Modal load of contact forces and increments, and what it adds to the modal state. */
static void drive(rc_track *track, const double *forces, const double *increment,
                  rc_track_state *state)
{
    const rc_basis *basis = &track->basis;
    const rc_operator *op = &track->operator_;
    const size_t half = basis->half, length = basis->length;
    double *opposed = track->small; /* the increments oppose the deformation */
    for (size_t a = 0; a < op->active.count; ++a)
        opposed[a] = -increment[a];
    rc_combine(state->load, op->contacts, forces, basis->wheels, length);
    if (op->linear) {
        rc_add_combination(state->load, op->active.rows, opposed, op->active.count, length);
        rc_multiply_add(state->modal, op->exponential->end, state->load, half);
        return;
    }
    rc_multiply_add(state->modal, op->exponential->drive, state->load, half);
    rc_combine(track->row, op->active.rows, opposed, op->active.count, length);
    rc_multiply_add(state->modal, op->exponential->end, track->row, half);
    for (size_t k = 0; k < length; ++k)
        state->load[k] += track->row[k];
}

static void press_contacts(const rc_track *track, const double *forces, const double *increment,
                           double *displacement)
{
    const rc_operator *op = &track->operator_;
    const size_t wheels = track->basis.wheels, stride = op->active.stride;
    for (size_t i = 0; i < wheels; ++i) {
        for (size_t j = 0; j < wheels; ++j)
            displacement[i] += op->contact_contact[i * wheels + j] * forces[j];
        for (size_t a = 0; a < op->active.count; ++a)
            displacement[i] -= op->contact_active[i * stride + a] * increment[a];
    }
}

void rc_press_rail(const rc_track *track, const double *forces, const double *increment,
                   double *displacement)
{
    memcpy(displacement, track->operator_.free_contact, track->basis.wheels * sizeof(double));
    press_contacts(track, forces, increment, displacement);
}

void rc_move_track(rc_track *track, rc_track_state *state, const double *forces)
{
    const rc_basis *basis = &track->basis;
    const rc_operator *op = &track->operator_;
    const rc_track_state start = rc_view_state(basis, op->start);
    memcpy(state->modal, op->free, basis->length * sizeof(double));
    drive(track, forces, op->increment, state);
    rc_press_rail(track, forces, op->increment, state->displacement);
    if (track->laws.pad == RC_VISCOELASTIC)
        rc_remember_pads(track, forces, state);
    const size_t components = rc_increments(&track->laws);
    memset(state->increment, 0, components * sizeof(double));
    for (size_t a = 0; a < op->active.count; ++a)
        state->increment[op->active.number[a]] = op->increment[a];
    for (size_t s = 0; s < components; ++s)
        state->increment_rate[s] = (state->increment[s] - start.increment[s]) / op->step;
    for (size_t i = 0; i < basis->wheels; ++i) {
        const int linear = op->linear;
        state->speed[i] = linear ? (op->position[i] - start.position[i]) / op->step : 0.0;
        state->force_rate[i] = linear ? (forces[i] - start.force[i]) / op->step : 0.0;
        state->position[i] = op->position[i];
        state->force[i] = forces[i];
    }
}

int rc_apply_operator(rc_track *track, rc_track_state *state, const double *forces)
{
    if (!rc_solve_increments(track, forces))
        return 0;
    rc_move_track(track, state, forces);
    return 1;
}

int rc_differentiate_operator(rc_track *track, const double *force_change, rc_track_state *change)
{
    const rc_basis *basis = &track->basis;
    const rc_operator *op = &track->operator_;
    const rc_track_state end = rc_view_state(basis, track->after);
    const size_t count = op->active.count, wheels = basis->wheels;
    double *increment = track->products;
    if (!rc_change_increments(track, end.force, force_change, increment))
        return 0;
    memset(change->modal, 0, basis->length * sizeof(double));
    drive(track, force_change, increment, change);
    memset(change->displacement, 0, wheels * sizeof(double));
    press_contacts(track, force_change, increment, change->displacement);
    memset(change->increment, 0, 4 * basis->supports * sizeof(double)); /* and their rates */
    for (size_t a = 0; a < count; ++a) {
        change->increment[op->active.number[a]] = increment[a];
        change->increment_rate[op->active.number[a]] = increment[a] / op->step;
    }
    for (size_t i = 0; i < wheels; ++i) {
        change->force[i] = force_change[i];
        change->force_rate[i] = op->linear ? force_change[i] / op->step : 0.0;
        change->position[i] = end.position[i];
        change->speed[i] = end.speed[i];
    }
    *change->offset = *end.offset;
    return 1;
}
