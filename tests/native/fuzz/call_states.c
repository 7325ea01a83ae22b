/* States are saved, restored, freed, serialised and forged. */
#include <stdlib.h>
#include <string.h>

#include "checksum.h"
#include "school.h"

static keepsake *draw_state(school *at)
{
    return &at->states[draw_below(&at->draw, STATES)];
}

static int is_own(const pupil *of, const keepsake *kept)
{
    return kept->handle != NULL && kept->owner == of->born;
}

static void remember(school *at, pupil *of, keepsake *kept, void *handle)
{
    kept->handle = handle;
    kept->owner = of->born;
    kept->of = of->is;
    kept->of.known = read_outputs(at, of, kept->of.outputs);
}

/* Into a new state, over one of its own, or over one of another instance. */
static void save(school *at, pupil *of)
{
    keepsake *kept = draw_state(at);
    void *handle = kept->handle;
    unsigned right = right_in(of, ANY);
    if (handle != NULL && !is_own(of, kept))
        right = MAY_ERROR;
    ask(at, of, "saving");
    if (draw_once_in(&at->draw, 40)) {
        judge(at, of, at->host->save(of->fmu, NULL), MAY_ERROR);
        return;
    }
    const answer given = at->host->save(of->fmu, &handle);
    judge(at, of, given, right);
    if (given != OK)
        return;
    if (handle == NULL || (kept->handle != NULL && handle != kept->handle))
        blame(at, "a state was saved elsewhere than it should");
    remember(at, of, kept, handle);
}

static void restore(school *at, pupil *of, const keepsake *kept)
{
    const unsigned right = kept->handle == NULL ? MAY_ERROR : right_in(of, ANY);
    const int whole = !kept->of.touched && !kept->of.tainted;
    ask(at, of, "restoring");
    const answer given = at->host->restore(of->fmu, kept->handle);
    judge(at, of, given, right == MAY_OK && !whole ? MAY_OK | MAY_ERROR : right);
    if (given == OK) {
        of->is = kept->of;
        compare(at, of, &kept->of);
    } else if (right == MAY_OK) { /* its parameters cannot be used any more */
        of->is = (knowledge){.phase = CREATED,
                             .touched = 1,
                             .tainted = kept->of.tainted || of->is.tainted};
    }
}

/* What is no state, though there is memory behind it. */
static void restore_junk(school *at, pupil *of)
{
    unsigned char *junk = exact(64, 1);
    void *handle = junk;
    for (size_t i = 0; i < 64; ++i)
        junk[i] = (unsigned char)draw_bits(&at->draw);
    ask(at, of, "restoring what is no state");
    judge(at, of, at->host->restore(of->fmu, junk), MAY_ERROR);
    ask(at, of, "freeing what is no state");
    judge(at, of, at->host->forget(of->fmu, &handle), MAY_ERROR);
    free(junk);
}

/* A state that was freed is no state any more. */
static void restore_freed(school *at, pupil *of, void *stale)
{
    size_t size;
    void *handle = stale;
    ask(at, of, "restoring a freed state");
    judge(at, of, at->host->restore(of->fmu, stale), MAY_ERROR);
    ask(at, of, "the size of a freed state");
    judge(at, of, at->host->size(of->fmu, stale, &size), MAY_ERROR);
    ask(at, of, "freeing a freed state");
    judge(at, of, at->host->forget(of->fmu, &handle), MAY_ERROR);
}

static void forget(school *at, pupil *of)
{
    keepsake *kept = draw_state(at);
    void *handle = kept->handle;
    unsigned right = right_in(of, ANY);
    if (handle != NULL && !is_own(of, kept))
        right = MAY_ERROR;
    ask(at, of, "freeing a state");
    const answer given = at->host->forget(of->fmu, &handle);
    judge(at, of, given, right);
    if (given != OK)
        return;
    if (handle != NULL)
        blame(at, "a freed state is not NULL");
    if (kept->handle != NULL)
        restore_freed(at, of, kept->handle);
    kept->handle = NULL;
}

void call_states(school *at, pupil *of)
{
    switch (draw_below(&at->draw, 10)) {
    case 0:
        restore_junk(at, of);
        break;
    case 1:
    case 2:
        forget(at, of);
        break;
    case 3:
    case 4:
    case 5:
        restore(at, of, draw_state(at));
        break;
    default:
        save(at, of);
    }
}

/* Both checksums of a serialised state, as those who forge one would set them. */
static void repair(unsigned char *bytes, size_t size)
{
    uint32_t own, checksum;
    memcpy(&own, bytes + 8, 4);
    if (own > size - 40)
        return;
    checksum = rc_checksum(bytes + 16, own);
    memcpy(bytes + 12, &checksum, 4);
    checksum = rc_checksum(bytes + 16 + own + 16, size - 16 - own - 16);
    memcpy(bytes + 16 + own + 12, &checksum, 4);
}

/* Alters the bytes; what that makes of them. */
typedef enum { GOOD, DAMAGED, FORGED } damage;

static damage alter(school *at, unsigned char *bytes, size_t *size)
{
    draw *from = &at->draw;
    switch (draw_below(from, 4)) {
    case 0:
        return GOOD;
    case 1:
        *size = draw_below(from, *size);
        return DAMAGED;
    case 2:
        bytes[draw_below(from, *size)] ^= (unsigned char)(1u << draw_below(from, 8));
        return DAMAGED;
    default:
        for (size_t i = 0; i < 3; ++i)
            bytes[16 + draw_below(from, *size - 16)] = (unsigned char)draw_bits(from);
        repair(bytes, *size);
        return FORGED;
    }
}

static void deserialise(school *at, pupil *of, const keepsake *source, const unsigned char *bytes,
                        size_t size, damage done)
{
    keepsake *kept = draw_state(at);
    void *handle = kept->handle;
    unsigned char *copy = exact(size, 1);
    memcpy(copy, bytes, size);
    unsigned right = done == DAMAGED ? MAY_ERROR : right_in(of, ANY);
    if (handle != NULL && !is_own(of, kept))
        right = MAY_ERROR;
    if (done == FORGED)
        right |= MAY_ERROR;
    ask(at, of, "deserialising");
    const answer given = at->host->deserialise(of->fmu, copy, size, &handle);
    judge(at, of, given, right);
    free(copy);
    if (given != OK)
        return;
    *kept = (keepsake){.handle = handle, .owner = of->born, .of = source->of};
    kept->of.tainted |= done == FORGED;
    if (draw_once_in(&at->draw, 2))
        restore(at, of, kept);
}

void call_bytes(school *at, pupil *of)
{
    const keepsake source = *draw_state(at);
    draw *from = &at->draw;
    size_t size = 0;
    const unsigned right = source.handle == NULL ? MAY_ERROR : right_in(of, ANY);
    ask(at, of, "the size of a serialised state");
    const answer given = at->host->size(of->fmu, source.handle, &size);
    judge(at, of, given, right);
    if (given != OK)
        return;
    const size_t room = draw_once_in(from, 8) ? draw_below(from, size) : size;
    unsigned char *bytes = exact(room, 1);
    ask(at, of, "serialising");
    const answer done = at->host->serialise(of->fmu, source.handle, bytes, room);
    judge(at, of, done, room < size ? MAY_ERROR : MAY_OK);
    if (done == OK) {
        const damage altered = alter(at, bytes, &size);
        deserialise(at, of, &source, bytes, size, altered);
    }
    free(bytes);
}
