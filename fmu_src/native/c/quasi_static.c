#include "quasi_static.h"

#include <string.h>

#include "dense.h"
#include "rows.h"

rc_quasi_static rc_lay_out_quasi_static(rc_track *track)
{
    const size_t stride = track->active.stride, square = stride * stride;
    double *at = track->small, *rows = track->duals; /* of both there is enough */
    const size_t length = track->basis.length;
    return (rc_quasi_static){.increment = at,
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

void rc_load_quasi_statically(rc_track *track, const rc_quasi_static *at, const double *forces)
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

void rc_deform_quasi_statically(rc_track *track, const rc_quasi_static *at, rc_track_state *state)
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

void rc_find_displacements(rc_track *track, const rc_quasi_static *at, const double *forces,
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
