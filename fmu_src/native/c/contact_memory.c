/* The memory of a track with contacts, beside that of the track. */
#include <stdlib.h>

#include "dense.h"
#include "track_contact.h"

size_t rc_count_contact(const rc_basis *basis)
{
    return rc_count_state(basis) + 11 * basis->wheels + 3;
}

rc_contact_state rc_view_contact(const rc_basis *basis, double *dynamic)
{
    const size_t wheels = basis->wheels;
    double *own = dynamic + rc_count_state(basis), *history = own + 5 * wheels;
    double *ages = history + 6 * wheels;
    return (rc_contact_state){.compression = own,
                              .ahead = own + wheels,
                              .origin = own + 2 * wheels,
                              .velocity = own + 3 * wheels,
                              .mean_velocity = own + 4 * wheels,
                              .history = {.count = 2 * wheels,
                                          .newest = history,
                                          .second = history + 2 * wheels,
                                          .third = history + 4 * wheels,
                                          .ages = ages},
                              .passed = ages + 2};
}

/* Numbers still to be handed out, or only counted while there are none. */
typedef struct {
    double *next;
    size_t count;
} store;

static double *take(store *from, size_t count)
{
    double *place = from->next;
    from->count += count;
    if (place != NULL)
        from->next += count;
    return place;
}

static void take_trial(store *from, rc_contact_trial *trial, size_t wheels, size_t room)
{
    trial->compression = take(from, wheels);
    trial->force = take(from, wheels);
    trial->miss = take(from, wheels);
    trial->increment = take(from, room);
    trial->increment_miss = take(from, room);
}

static void take_all(store *from, rc_track_contact *own)
{
    const rc_basis *basis = &own->track.basis;
    const size_t wheels = basis->wheels, room = own->track.room;
    rc_contact_work *work = &own->work;
    own->before = take(from, rc_count_contact(basis));
    own->after = take(from, rc_count_contact(basis));
    own->given = take(from, 2 * wheels);
    own->moved = take(from, 2 * wheels);
    own->rate = take(from, 2 * wheels);
    own->wheels = take(from, 2 * wheels);
    own->level = take(from, wheels);
    own->force = take(from, wheels);
    take_trial(from, &work->trials[0], wheels, room);
    take_trial(from, &work->trials[1], wheels, room);
    work->change = take(from, wheels);
    work->increment_change = take(from, room);
    work->push = take(from, wheels);
    work->demand = take(from, room);
    work->response = take(from, wheels * room);
    work->relief = take(from, wheels * room);
    work->displacement = take(from, wheels * wheels);
    work->matrix = take(from, wheels * rc_stride(wheels));
}

rc_status rc_claim_contact(rc_model *model, rc_track_contact *own)
{
    const size_t wheels = own->track.basis.wheels;
    store sizes = {NULL, 0};
    rc_release_contact(own);
    take_all(&sizes, own);
    own->memory = calloc(sizes.count, sizeof(double));
    own->work.pivot = calloc(wheels, sizeof(size_t));
    if (own->memory == NULL || own->work.pivot == NULL)
        return rc_fail(model, RC_ERROR, "there is not enough memory for the contacts");
    store all = {own->memory, 0};
    take_all(&all, own);
    return RC_OK;
}

void rc_release_contact(rc_track_contact *own)
{
    free(own->memory);
    free(own->work.pivot);
    own->memory = NULL;
    own->work.pivot = NULL;
}
