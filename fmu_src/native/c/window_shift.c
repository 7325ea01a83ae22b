/* Moves the window of an endless track by whole bays, through the physical state; twin of
 * track_fmu/window_shift.py. */
#include <string.h>

#include "observation.h"
#include "rows.h"
#include "window.h"

#define BLOCK 12 /* rows at a time */

typedef struct {
    double *displacement, *velocity; /* moved */
    double *momentum, *inertia;      /* C x + M v, M x */
} field;

static field view_field(const rc_track *track)
{
    const size_t size = rc_field_size(&track->basis);
    return (field){track->field, track->field + size, track->field + 2 * size,
                   track->field + 3 * size};
}

/* The modal row of a place in a field. */
static const double *field_shape(const rc_basis *basis, size_t place)
{
    const size_t first = 2 * basis->nodes;
    return place < first || basis->bent_shape == NULL
               ? rc_shape(basis, place)
               : basis->bent_shape + (place - first) * basis->length;
}

/* Adds the field of forces on coordinates. */
static void add_field(const rc_basis *basis, double *out, const size_t *coordinate,
                      const double *loads, size_t count)
{
    const size_t first = 2 * basis->nodes, all = basis->supports * basis->sleeper_size;
    const double *rail[4], *sleepers[4];
    for (size_t k = 0; k < count; ++k) { /* the matrix is symmetric */
        rail[k] = rc_flexibility(basis, coordinate[k]);
        sleepers[k] = basis->bent_flexibility == NULL
                          ? rail[k] + first
                          : basis->bent_flexibility + coordinate[k] * all;
    }
    rc_add_combination(out, rail, loads, count, first);
    rc_add_combination(out + first, sleepers, loads, count, all);
}

/* Displacements of all nodes and sleepers by the forces on them, without modes. */
static void yield_statically(const rc_track *track, const rc_track_state *state, double *out)
{
    const rc_basis *basis = &track->basis;
    memset(out, 0, rc_field_size(basis) * sizeof(double));
    for (size_t i = 0; i < basis->wheels; ++i) {
        const rc_rail_point *wheel = &track->points[i];
        size_t coordinates[4];
        double loads[4];
        for (size_t k = 0; k < 4; ++k) {
            coordinates[k] = rc_first(wheel) + k;
            loads[k] = state->force[i] * wheel->shape[k];
        }
        add_field(basis, out, coordinates, loads, 4);
    }
    for (size_t s = 0; s < rc_increments(&track->laws); ++s) {
        const size_t coordinate = rc_component(basis, s);
        const double load = -state->increment[s];
        if (load != 0.0)
            add_field(basis, out, &coordinate, &load, 1);
    }
}

/* Fills in displacement and velocity of `count` places from `from` on, at `to`. */
static void fill(const rc_track *track, const field *at, size_t from, size_t to, size_t count)
{
    const rc_basis *basis = &track->basis;
    const double *const motion[2] = {track->row, track->other_row};
    for (size_t done = 0; done < count; done += BLOCK) {
        const size_t rows = count - done < BLOCK ? count - done : BLOCK;
        const double *shape[BLOCK];
        double products[2 * BLOCK];
        for (size_t r = 0; r < rows; ++r)
            shape[r] = field_shape(basis, from + done + r);
        rc_products(shape, rows, motion, 2, basis->length, products, 2);
        for (size_t r = 0; r < rows; ++r) {
            at->displacement[to + done + r] = products[2 * r] + at->momentum[from + done + r];
            at->velocity[to + done + r] = products[2 * r + 1];
        }
    }
}

/* Values that many places further on, zeros where there are none. */
static void shift(double *values, size_t count, ptrdiff_t places)
{
    const size_t by = (size_t)(places < 0 ? -places : places);
    const size_t kept = by < count ? count - by : 0, gone = count - kept;
    memmove(places < 0 ? values + gone : values, places < 0 ? values : values + gone,
            kept * sizeof(double));
    memset(places < 0 ? values : values + kept, 0, gone * sizeof(double));
}

void rc_shift_field(rc_track *track, rc_track_state *state, ptrdiff_t bays)
{
    const rc_basis *basis = &track->basis;
    const field at = view_field(track);
    const size_t by = (size_t)(bays < 0 ? -bays : bays);
    const size_t per_bay = basis->elements / (basis->supports + 1);
    const size_t nodes = basis->nodes - by * per_bay; /* by is less than the bays */
    const size_t size = basis->sleeper_size, left = by * size;
    const size_t sleepers = (basis->supports - by) * size, gone = 2 * by * per_bay;
    const size_t first = 2 * basis->nodes;
    memset(at.displacement, 0, 2 * rc_field_size(basis) * sizeof(double)); /* and velocities */
    yield_statically(track, state, at.momentum);
    rc_view_motion(basis, state, track->row, track->other_row);
    fill(track, &at, bays < 0 ? 0 : gone, bays < 0 ? gone : 0, 2 * nodes);
    fill(track, &at, first + (bays < 0 ? 0 : left), first + (bays < 0 ? left : 0), sleepers);
    for (size_t side = 0; side < 2; ++side) /* the ends are clamped */
        for (size_t k = 0; k < 2; ++k) {
            const size_t end = (side == 0 ? 0 : 2 * (basis->nodes - 1)) + k;
            at.displacement[end] = at.velocity[end] = 0.0;
        }
    double *const values[] = {state->increment, state->increment_rate};
    for (size_t k = 0; k < 2; ++k) /* of ballast, then of pads */
        for (size_t kind = 0; kind < 2; ++kind)
            shift(values[k] + kind * basis->supports, basis->supports, bays);
    shift(state->branch_force, basis->supports, bays);
    shift(state->compression, basis->supports, bays);
    shift(state->known, basis->supports, bays);
}

/* What `weigh` does for a sleeper, its places beginning at `below`, under the rail node at `above`. */
static void weigh_sleeper(const rc_basis *basis, const field *at, size_t below, size_t above)
{
    const size_t size = basis->sleeper_size, seat = below + basis->seat;
    const double *x = at->displacement + below, *v = at->velocity + below;
    const double pad = basis->pad_damping * (at->displacement[above] - at->displacement[seat]);
    for (size_t i = 0; i < size; ++i) {
        const double *mass = basis->sleeper_mass + i * size, *bed = basis->sleeper_bed + i * size;
        double momentum = 0.0, inertia = 0.0, pressed = 0.0;
        for (size_t j = 0; j < size; ++j) {
            momentum += mass[j] * v[j];
            inertia += mass[j] * x[j];
            pressed += bed[j] * x[j];
        }
        at->momentum[below + i] = momentum + basis->ballast_damping * pressed;
        at->inertia[below + i] = inertia;
    }
    at->momentum[above] += pad;
    at->momentum[seat] -= pad;
}

/* Mass times displacements and velocities, and damping times displacements. */
static void weigh(const rc_track *track, const field *at)
{
    const rc_basis *basis = &track->basis;
    const double *mass = basis->inertia;
    memset(at->momentum, 0, 2 * rc_field_size(basis) * sizeof(double)); /* and inertia */
    for (size_t e = 0; e < basis->elements; ++e)
        for (size_t i = 0; i < 4; ++i)
            for (size_t j = 0; j < 4; ++j) {
                at->momentum[2 * e + i] += mass[4 * i + j] * at->velocity[2 * e + j];
                at->inertia[2 * e + i] += mass[4 * i + j] * at->displacement[2 * e + j];
            }
    for (size_t s = 0; s < basis->supports; ++s)
        weigh_sleeper(basis, at, 2 * basis->nodes + s * basis->sleeper_size, rc_above(basis, s));
}

void rc_project_field(rc_track *track, rc_track_state *state)
{
    const rc_basis *basis = &track->basis;
    const field at = view_field(track);
    const size_t size = rc_field_size(basis), length = basis->length;
    const double *rows[BLOCK];
    weigh(track, &at);
    memset(state->modal, 0, length * sizeof(double));
    memset(track->row, 0, length * sizeof(double));
    for (size_t done = 0; done < size; done += BLOCK) {
        const size_t count = size - done < BLOCK ? size - done : BLOCK;
        for (size_t r = 0; r < count; ++r)
            rows[r] = field_shape(basis, done + r);
        rc_add_combination(state->modal, rows, at.momentum + done, count, length);
        rc_add_combination(track->row, rows, at.inertia + done, count, length);
    }
    rc_multiply_add(state->modal, basis->eigenvalues, track->row, basis->half);
}
