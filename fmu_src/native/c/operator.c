/* One step of the track as a small affine map of the contact forces.
 *
 * What has the length of a row is worked out once a step; a host that repeats the step with other
 * forces pays for small matrices and for the new modal state.
 */
#include <string.h>

#include "rows.h"
#include "window.h"

/* Places among the rows of track->duals. */
static size_t drive_at(size_t wheel)
{
    return 1 + wheel;
}

static size_t free_rate_at(const rc_basis *basis)
{
    return 1 + basis->wheels;
}

static size_t drive_rate_at(const rc_basis *basis, size_t wheel)
{
    return 2 + basis->wheels + wheel;
}

static size_t end_at(const rc_basis *basis, size_t wheel)
{
    return 2 + 2 * basis->wheels + wheel;
}

/* Behind the others, if a law asks for accelerations. */
static size_t free_acceleration_at(const rc_basis *basis)
{
    return 2 + 3 * basis->wheels;
}

static size_t drive_acceleration_at(const rc_basis *basis, size_t wheel)
{
    return 3 + 3 * basis->wheels + wheel;
}

static int serves(const rc_track *track, const double *dynamic, double step, int linear,
                  const double *positions)
{
    const rc_operator *op = &track->operator_;
    return op->made && op->step == step && op->linear == linear &&
           memcmp(op->position, positions, track->basis.wheels * sizeof(double)) == 0 &&
           memcmp(op->start, dynamic, rc_count_state(&track->basis) * sizeof(double)) == 0;
}

/* The modal load of the increments alone. */
static void add_increments(double *load, const rc_basis *basis, const double *increment,
                           size_t components)
{
    const double *rows[4];
    double factors[4];
    size_t count = 0;
    memset(load, 0, basis->length * sizeof(double));
    for (size_t number = 0; number < components; ++number) {
        if (increment[number] != 0.0) {
            rows[count] = rc_shape(basis, rc_component(basis, number));
            factors[count++] = -increment[number];
        }
        if (count == 4 || number + 1 == components) {
            rc_add_combination(load, rows, factors, count, basis->length);
            count = 0;
        }
    }
}

void rc_load_track(rc_track *track, rc_track_state *state)
{
    const rc_basis *basis = &track->basis;
    const size_t length = basis->length, half = basis->half;
    double *dual = track->duals, *row = track->row;
    const double *const rows[1] = {row};
    const size_t components = rc_increments(&track->laws);
    add_increments(state->load, basis, state->increment, components);
    for (size_t n = 0; n < half; ++n) {
        dual[n] = basis->weight[n] * state->modal[n];
        dual[half + n] = -basis->weight[n] * state->modal[half + n];
    }
    for (size_t i = 0; i < basis->wheels; ++i) {
        const rc_rail_point *wheel = &track->points[i];
        rc_modes_at(basis, wheel, wheel->shape, row);
        rc_add_combination(state->load, rows, &state->force[i], 1, length);
        double sum = rc_product(row, dual, length);
        for (size_t j = 0; j < basis->wheels; ++j)
            sum += rc_residual_between(basis, wheel, wheel->shape, &track->points[j],
                                       track->points[j].shape) * state->force[j];
        for (size_t s = 0; s < components; ++s)
            if (state->increment[s] != 0.0)
                sum -= rc_residual(basis, wheel, rc_component(basis, s)) * state->increment[s];
        state->displacement[i] = sum;
    }
}

/* The modal state that the step would end with if there were no forces at its end. */
static void move_freely(rc_track *track, const rc_track_state *state)
{
    const rc_basis *basis = &track->basis;
    rc_operator *op = &track->operator_;
    const double *load = state->load;
    if (!op->linear) { /* the contact forces jump; the increments do not */
        add_increments(track->row, basis, state->increment, rc_increments(&track->laws));
        load = track->row;
    }
    rc_multiply(op->free, op->exponential->decay, state->modal, basis->half);
    rc_multiply_add(op->free, op->exponential->start, load, basis->half);
}

/* The dual rows whose products with the modal deformations make the operator. */
static void fill_duals(rc_track *track)
{
    const rc_basis *basis = &track->basis;
    const rc_operator *op = &track->operator_;
    const size_t half = basis->half, length = basis->length;
    double *free = track->duals, *rate = track->duals + free_rate_at(basis) * length;
    for (size_t n = 0; n < half; ++n) {
        free[n] = basis->weight[n] * op->free[n];
        free[half + n] = basis->weight[n] * op->free[half + n];
    }
    rc_multiply_dual(rate, basis->eigenvalues, free, half);
    for (size_t n = half; n < length; ++n)
        free[n] = -free[n];
    for (size_t j = 0; j < basis->wheels; ++j) {
        const double *contact = op->contacts[j];
        rc_multiply_dual(track->duals + drive_at(j) * length, op->exponential->drive_dual, contact,
                         half);
        rc_multiply_dual(track->duals + drive_rate_at(basis, j) * length,
                         op->exponential->drive_rate, contact, half);
        if (!op->linear)
            rc_multiply_dual(track->duals + end_at(basis, j) * length, op->exponential->end_dual,
                             contact, half);
    }
}

/* Accelerations of the active components: free, and per contact force. */
static void fill_accelerations(rc_track *track)
{
    const rc_basis *basis = &track->basis;
    rc_operator *op = &track->operator_;
    const size_t half = basis->half, length = basis->length, stride = op->active.stride;
    const size_t first = free_acceleration_at(basis);
    double *products = track->products;
    rc_multiply_duals(track->duals + first * length, basis->eigenvalues,
                      track->duals + free_rate_at(basis) * length, half);
    for (size_t j = 0; j < basis->wheels; ++j)
        rc_multiply_dual(track->duals + drive_acceleration_at(basis, j) * length,
                         op->exponential->drive_acceleration, op->contacts[j], half);
    rc_products(track->dual_rows + first, 1 + basis->wheels, op->active.rows, op->active.count,
                length, products, stride);
    memcpy(op->free_acceleration, products, stride * sizeof(double));
    memcpy(op->acceleration_contact, products + stride, basis->wheels * stride * sizeof(double));
}

static void fill_contacts(rc_track *track)
{
    const rc_basis *basis = &track->basis;
    rc_operator *op = &track->operator_;
    const size_t wheels = basis->wheels, columns = 1 + wheels;
    double *products = track->products;
    rc_products(op->contacts, wheels, track->dual_rows, columns, basis->length, products, columns);
    for (size_t i = 0; i < wheels; ++i) {
        op->free_contact[i] = products[i * columns];
        for (size_t j = 0; j < wheels; ++j)
            op->contact_contact[i * wheels + j] =
                products[i * columns + drive_at(j)] +
                rc_residual_between(basis, &op->wheels[i], op->wheels[i].shape, &op->wheels[j],
                                    op->wheels[j].shape);
    }
}

static void fill_active(rc_track *track)
{
    const rc_basis *basis = &track->basis;
    rc_operator *op = &track->operator_;
    const size_t stride = op->active.stride, count = op->active.count;
    const size_t rows = op->linear ? end_at(basis, 0) : end_at(basis, basis->wheels);
    double *products = track->products;
    rc_products(track->dual_rows, rows, op->active.rows, count, basis->length, products, stride);
    memcpy(op->free_active, products, stride * sizeof(double));
    memcpy(op->free_rate, products + free_rate_at(basis) * stride, stride * sizeof(double));
    for (size_t j = 0; j < basis->wheels; ++j) {
        const double *drive = products + drive_at(j) * stride;
        const double *end = op->linear ? drive : products + end_at(basis, j) * stride;
        memcpy(op->rate_contact + j * stride, products + drive_rate_at(basis, j) * stride,
               stride * sizeof(double));
        for (size_t a = 0; a < count; ++a) {
            const double residual =
                rc_residual(basis, &op->wheels[j], rc_component(basis, op->active.number[a]));
            op->active_contact[j * stride + a] = drive[a] + residual;
            op->contact_active[j * stride + a] = end[a] + residual;
        }
    }
}

void rc_prepare_operator(rc_track *track, const double *dynamic, double step, int linear,
                         const double *positions)
{
    const rc_basis *basis = &track->basis;
    rc_operator *op = &track->operator_;
    if (serves(track, dynamic, step, linear, positions))
        return;
    op->made = 0;
    op->step = step;
    op->linear = linear;
    memcpy(op->start, dynamic, rc_count_state(basis) * sizeof(double));
    memcpy(op->position, positions, basis->wheels * sizeof(double));
    const rc_track_state state = rc_view_state(basis, op->start);
    const double begin = rc_window_position(basis, &state);
    for (size_t i = 0; i < basis->wheels; ++i) {
        rc_locate(basis, positions[i] - begin, &op->wheels[i]); /* was found to be there before */
        rc_modes_at(basis, &op->wheels[i], op->wheels[i].shape, op->contact + i * basis->length);
    }
    rc_choose_supports(track, &state, positions);
    rc_copy_active(&op->active, &track->active);
    op->exponential = rc_coefficients(&track->exponentials, basis, step, linear,
                                      track->laws.inertial, &op->active, track->scratch);
    move_freely(track, &state);
    fill_duals(track);
    fill_contacts(track);
    fill_active(track);
    if (track->laws.inertial)
        fill_accelerations(track);
    if (!rc_is_stiff(&track->laws))
        rc_linearise_increments(track, state.force, NULL);
    op->made = 1;
}
