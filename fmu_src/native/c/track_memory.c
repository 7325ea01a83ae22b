/* The memory of a track, in one piece. */
#include <stdlib.h>

#include "dense.h"
#include "window.h"

size_t rc_count_state(const rc_basis *basis)
{
    return 5 * basis->wheels + 7 * basis->supports + 2 * basis->length + 1;
}

rc_track_state rc_view_state(const rc_basis *basis, double *values)
{
    const size_t wheels = basis->wheels;
    const size_t supports = basis->supports;
    double *increment = values + 5 * wheels, *memory = increment + 4 * supports;
    double *rows = memory + 3 * supports;
    return (rc_track_state){.position = values,
                            .speed = values + wheels,
                            .force = values + 2 * wheels,
                            .force_rate = values + 3 * wheels,
                            .displacement = values + 4 * wheels,
                            .increment = increment,
                            .increment_rate = increment + 2 * supports,
                            .branch_force = memory,
                            .compression = memory + supports,
                            .known = memory + 2 * supports,
                            .modal = rows,
                            .load = rows + basis->length,
                            .offset = rows + 2 * basis->length};
}

int rc_is_finite(const rc_basis *basis, const rc_track_state *state)
{
    double sums[4] = {0.0}; /* of differences with themselves: zero or no number */
    const double *values = state->position;
    for (size_t i = 0; i < 5 * basis->wheels + 7 * basis->supports; ++i)
        sums[i % 4] += values[i] - values[i];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]) == 0.0;
}

/* Hands out memory, or only measures it while `memory` is NULL. */
typedef struct {
    unsigned char *memory;
    size_t used;
} store;

#define ALIGNMENT 64u /* a cache line */

static void *take(store *from, size_t count, size_t size)
{
    void *place = from->memory == NULL ? NULL : from->memory + from->used;
    from->used += (count * size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    return place;
}

static double *numbers(store *from, size_t count)
{
    return take(from, count, sizeof(double));
}

static void take_active(store *from, rc_active *active, size_t room)
{
    active->count = 0;
    active->number = take(from, room, sizeof(size_t));
    active->rows = take(from, room, sizeof(double *));
}

static void take_operator(store *from, rc_operator *op, const rc_basis *basis, size_t room)
{
    const size_t wheels = basis->wheels;
    op->made = 0;
    op->start = numbers(from, rc_count_state(basis));
    op->position = numbers(from, wheels);
    op->wheels = take(from, wheels, sizeof(rc_rail_point));
    take_active(from, &op->active, room);
    op->contact = numbers(from, wheels * basis->length);
    op->contacts = take(from, wheels, sizeof(double *));
    op->free = numbers(from, basis->length);
    op->free_contact = numbers(from, wheels);
    op->contact_contact = numbers(from, wheels * wheels);
    op->free_active = numbers(from, room);
    op->free_rate = numbers(from, room);
    op->active_contact = numbers(from, wheels * room);
    op->rate_contact = numbers(from, wheels * room);
    op->contact_active = numbers(from, wheels * room);
    op->stiffness = numbers(from, room);
    op->damping = numbers(from, room);
    op->correction = numbers(from, room * room);
    op->increment = numbers(from, room);
}

static void take_exponential(store *from, rc_exponential *slot, size_t length, size_t room)
{
    double **const rows[] = {&slot->decay, &slot->start, &slot->end, &slot->drive,
                             &slot->drive_dual, &slot->drive_rate, &slot->end_dual,
                             &slot->end_rate};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i)
        *rows[i] = numbers(from, length);
    slot->step = 0.0;
    slot->used = 0;
    take_active(from, &slot->active, room);
    slot->coupling = numbers(from, room * room);
    slot->rate_coupling = numbers(from, room * room);
}

static void take_all(store *from, rc_track *track, size_t room)
{
    const rc_basis *basis = &track->basis;
    const size_t wheels = basis->wheels, length = basis->length, duals = 2 + 3 * wheels;
    const size_t state = rc_count_state(basis);
    track->gauge_position = numbers(from, basis->gauges);
    track->points = take(from, wheels, sizeof(rc_rail_point));
    for (size_t i = 0; i < RC_REMEMBERED_STEPS; ++i)
        take_exponential(from, &track->exponentials.slots[i], length, room);
    track->exponentials.last = NULL;
    track->exponentials.clock = 0;
    take_operator(from, &track->operator_, basis, room);
    take_active(from, &track->active, room);
    track->first = take(from, wheels, sizeof(size_t));
    track->pivot = take(from, room, sizeof(size_t));
    track->duals = numbers(from, duals * length);
    track->dual_rows = take(from, duals, sizeof(double *));
    track->products = numbers(from, 3 * room * room + duals * room + wheels * (1 + wheels));
    track->scratch = numbers(from, RC_COUPLING_COLUMNS * (length + room));
    track->small = numbers(from, RC_SMALL_ROWS * room);
    track->row = numbers(from, length);
    track->other_row = numbers(from, length);
    track->inside = numbers(from, wheels);
    track->field = numbers(from, 4 * rc_field_size(basis));
    track->before = numbers(from, state);
    track->after = numbers(from, state);
    track->change = numbers(from, state);
    track->position = numbers(from, wheels);
    track->force = numbers(from, wheels);
    track->moved = numbers(from, wheels);
    track->pressed = numbers(from, wheels);
}

static void release_memory(rc_track *track)
{
    free(track->memory);
    track->memory = NULL;
}

rc_status rc_claim_track(rc_model *model, rc_track *track)
{
    const rc_basis *basis = &track->basis;
    const size_t per_wheel =
        track->per_wheel < basis->supports ? track->per_wheel : basis->supports;
    const size_t most = basis->wheels * per_wheel < basis->supports ? basis->wheels * per_wheel
                                                                    : basis->supports;
    const size_t room = track->room = rc_stride(most * rc_kinds(&track->laws));
    store sizes = {NULL, 0};
    release_memory(track);
    take_all(&sizes, track, room);
    track->memory = calloc(1, sizes.used + ALIGNMENT);
    if (track->memory == NULL)
        return rc_fail(model, RC_ERROR, "there is not enough memory for the track");
    const size_t beyond = (size_t)((uintptr_t)track->memory % ALIGNMENT);
    store all = {(unsigned char *)track->memory + (ALIGNMENT - beyond), 0};
    take_all(&all, track, room);
    for (size_t i = 0; i < basis->wheels; ++i)
        track->operator_.contacts[i] = track->operator_.contact + i * basis->length;
    for (size_t i = 0; i < 2 + 3 * basis->wheels; ++i)
        track->dual_rows[i] = track->duals + i * basis->length;
    return RC_OK;
}

void rc_release_track(rc_track *track)
{
    release_memory(track);
    rc_free_laws(&track->laws);
}

void rc_choose_supports(rc_track *track, const rc_track_state *state, const double *positions)
{
    const double begin = rc_window_position(&track->basis, state);
    for (size_t i = 0; i < track->basis.wheels; ++i)
        track->inside[i] = positions[i] - begin;
    track->active.first_support = (ptrdiff_t)*state->offset;
    const int ballast = track->laws.ballast != RC_NO_INCREMENT;
    const int pads = track->laws.pad != RC_NO_INCREMENT;
    if (ballast || pads)
        rc_choose_active(&track->active, &track->basis, track->inside, track->per_wheel, ballast, pads,
                         track->first);
    else
        track->active.count = track->active.stride = 0;
}
