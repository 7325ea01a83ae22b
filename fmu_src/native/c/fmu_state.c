/* Saved states of an FMU's instance.
 *
 * Serialised: char[4] "RCFM", u32 format version, u32 size of the part of the FMU, u32 CRC-32 of
 * that part, then that part (rc_fmu_head, slopes, last inputs) and the serialised state of the
 * model. Little-endian.
 */
#include <stdlib.h>
#include <string.h>

#include "checksum.h"
#include "fmu.h"
#include "instance.h"

#define FORMAT 1u
#define HEAD 16u

static const char MAGIC[4] = {'R', 'C', 'F', 'M'};

/* A saved state; its bytes follow. The instance keeps all that it made until its own end, those
 * that were freed for its next states, so that a stale pointer is known as such. */
typedef struct rc_saved rc_saved;
struct rc_saved {
    char magic[4];
    uint32_t identity; /* of the resource */
    uint64_t size;
    const rc_fmu *owner;
    rc_saved *next;      /* of the same owner */
    rc_saved *next_free;
    uint64_t freed;
};

static unsigned char *bytes_of(const rc_saved *saved)
{
    return (unsigned char *)(saved + 1);
}

static size_t saved_size(const rc_fmu *fmu)
{
    return fmu->own_size + rc_state_size(fmu->model);
}

/* The state behind a pointer; NULL and a sentence if that is none of this FMU. */
static const rc_saved *check(rc_fmu *fmu, const void *pointer)
{
    const rc_saved *saved = pointer;
    const char *fault = NULL;
    if (saved == NULL)
        fault = "the state is NULL";
    else if (memcmp(saved->magic, MAGIC, sizeof MAGIC) != 0 || saved->size != saved_size(fmu) ||
             saved->identity != fmu->model->resource.checksum)
        fault = "this is no state of such an FMU";
    else if (saved->freed)
        fault = "this state was freed before";
    if (fault == NULL)
        return saved;
    (void)rc_fmu_refuse(fmu, RC_ERROR, "%s", fault);
    return NULL;
}

/* The same for a state that is to be changed or freed, which only its own instance may. */
static rc_saved *check_own(rc_fmu *fmu, void *pointer)
{
    const rc_saved *saved = check(fmu, pointer);
    if (saved == NULL || saved->owner == fmu)
        return saved == NULL ? NULL : pointer;
    (void)rc_fmu_refuse(fmu, RC_ERROR, "this state was saved by another instance, which alone may "
                                       "change or free it");
    return NULL;
}

/* The place for a state: that which is there, or a new one. */
static rc_saved *place(rc_fmu *fmu, void *present)
{
    if (present != NULL)
        return check_own(fmu, present);
    rc_saved *saved = fmu->freed_states;
    if (saved != NULL) {
        fmu->freed_states = saved->next_free;
        saved->freed = 0;
        return saved;
    }
    saved = malloc(sizeof *saved + saved_size(fmu));
    if (saved == NULL) {
        (void)rc_fmu_refuse(fmu, RC_ERROR, "there is not enough memory for another state");
        return NULL;
    }
    *saved = (rc_saved){.identity = fmu->model->resource.checksum,
                        .size = saved_size(fmu),
                        .owner = fmu,
                        .next = fmu->states};
    memcpy(saved->magic, MAGIC, sizeof MAGIC);
    fmu->states = saved;
    return saved;
}

static void give_back(rc_fmu *fmu, rc_saved *saved)
{
    saved->freed = 1;
    saved->next_free = fmu->freed_states;
    fmu->freed_states = saved;
}

void rc_fmu_free_states(rc_fmu *fmu)
{
    rc_saved *next;
    for (rc_saved *saved = fmu->states; saved != NULL; saved = next) {
        next = saved->next;
        free(saved);
    }
}

rc_status rc_fmu_save(rc_fmu *fmu, void **saved)
{
    rc_saved *to = place(fmu, *saved);
    if (to == NULL)
        return RC_ERROR;
    memcpy(bytes_of(to), fmu->head, fmu->own_size);
    rc_save(fmu->model, bytes_of(to) + fmu->own_size);
    *saved = to;
    return RC_OK;
}

rc_status rc_fmu_restore(rc_fmu *fmu, const void *saved)
{
    const rc_saved *from = check(fmu, saved);
    if (from == NULL)
        return RC_ERROR;
    const rc_status status = rc_restore(fmu->model, bytes_of(from) + fmu->own_size);
    if (status == RC_OK)
        memcpy(fmu->head, bytes_of(from), fmu->own_size);
    else if (rc_current_phase(fmu->model) == RC_INSTANTIATED)
        memset(fmu->head, 0, fmu->own_size); /* to be initialised again, whatever it was before */
    return rc_fmu_pass(fmu, status);
}

rc_status rc_fmu_forget(rc_fmu *fmu, void **saved)
{
    if (*saved == NULL)
        return RC_OK;
    rc_saved *own = check_own(fmu, *saved);
    if (own == NULL)
        return RC_ERROR;
    give_back(fmu, own);
    *saved = NULL;
    return RC_OK;
}

rc_status rc_fmu_serialised_size(rc_fmu *fmu, const void *saved, size_t *size)
{
    if (check(fmu, saved) == NULL)
        return RC_ERROR;
    *size = HEAD + fmu->own_size + rc_serialised_size(fmu->model);
    return RC_OK;
}

rc_status rc_fmu_serialise(rc_fmu *fmu, const void *saved, void *bytes, size_t size)
{
    const rc_saved *from = check(fmu, saved);
    unsigned char *to = bytes;
    const size_t needed = HEAD + fmu->own_size + rc_serialised_size(fmu->model);
    if (from == NULL)
        return RC_ERROR;
    if (size < needed)
        return rc_fmu_refuse(fmu, RC_ERROR, "a state takes %zu bytes; there is room for %zu only",
                             needed, size);
    const uint32_t format = FORMAT, own = (uint32_t)fmu->own_size;
    const uint32_t checksum = rc_checksum(bytes_of(from), fmu->own_size);
    memcpy(to, MAGIC, sizeof MAGIC);
    memcpy(to + 4, &format, 4);
    memcpy(to + 8, &own, 4);
    memcpy(to + 12, &checksum, 4);
    memcpy(to + HEAD, bytes_of(from), fmu->own_size);
    rc_serialise(fmu->model, bytes_of(from) + fmu->own_size, to + HEAD + fmu->own_size);
    return RC_OK;
}

rc_status rc_fmu_deserialise(rc_fmu *fmu, const void *bytes, size_t size, void **saved)
{
    const unsigned char *from = bytes;
    const size_t before = HEAD + fmu->own_size;
    uint32_t format, own, checksum;
    if (size < before || memcmp(from, MAGIC, sizeof MAGIC) != 0)
        return rc_fmu_refuse(fmu, RC_ERROR, "these bytes are not a serialised state of this FMU");
    memcpy(&format, from + 4, 4);
    memcpy(&own, from + 8, 4);
    memcpy(&checksum, from + 12, 4);
    if (format != FORMAT)
        return rc_fmu_refuse(fmu, RC_ERROR, "the serialised state has format %lu; this FMU reads "
                                            "%u", (unsigned long)format, FORMAT);
    if (own != fmu->own_size || rc_checksum(from + HEAD, fmu->own_size) != checksum)
        return rc_fmu_refuse(fmu, RC_ERROR, "the serialised state is truncated or altered, or of "
                                            "another FMU");
    rc_saved *to = place(fmu, *saved);
    if (to == NULL)
        return RC_ERROR;
    const rc_status status = rc_deserialise(fmu->model, from + before, size - before,
                                            bytes_of(to) + fmu->own_size);
    if (status != RC_OK) {
        if (*saved == NULL)
            give_back(fmu, to);
        return rc_fmu_pass(fmu, status);
    }
    memcpy(bytes_of(to), from + HEAD, fmu->own_size);
    *saved = to;
    return RC_OK;
}
