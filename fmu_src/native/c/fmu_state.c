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

#define FORMAT 1u
#define HEAD 16u

static const char MAGIC[4] = {'R', 'C', 'F', 'M'};

/* A saved state: its size, by which other pointers are told from it, then its bytes. */
typedef struct {
    char magic[4];
    uint32_t format;
    uint64_t size;
} rc_saved;

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
    if (saved != NULL && memcmp(saved->magic, MAGIC, sizeof MAGIC) == 0 &&
        saved->size == saved_size(fmu))
        return saved;
    (void)rc_fmu_refuse(fmu, RC_ERROR, saved == NULL ? "the state is NULL"
                                                     : "this is no state of such an FMU");
    return NULL;
}

/* The place for a state: that which is there, or a new one. */
static rc_saved *place(rc_fmu *fmu, void *present)
{
    if (present != NULL)
        return check(fmu, present) == NULL ? NULL : present;
    rc_saved *saved = malloc(sizeof *saved + saved_size(fmu));
    if (saved == NULL) {
        (void)rc_fmu_refuse(fmu, RC_ERROR, "there is not enough memory for another state");
        return NULL;
    }
    memcpy(saved->magic, MAGIC, sizeof MAGIC);
    saved->format = FORMAT;
    saved->size = saved_size(fmu);
    return saved;
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
    return rc_fmu_pass(fmu, status);
}

rc_status rc_fmu_forget(rc_fmu *fmu, void **saved)
{
    if (*saved == NULL)
        return RC_OK;
    if (check(fmu, *saved) == NULL)
        return RC_ERROR;
    free(*saved);
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
            free(to);
        return rc_fmu_pass(fmu, status);
    }
    memcpy(bytes_of(to), from + HEAD, fmu->own_size);
    *saved = to;
    return RC_OK;
}
