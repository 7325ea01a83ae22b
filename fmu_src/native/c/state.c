/* States of an instance: copies of its block, and those with a head for the way elsewhere.
 *
 * Serialised: char[4] "RCSN", u32 format version, u32 checksum of the resource, u32 CRC-32 of
 * everything behind it, u64 size of the block, then the block. Little-endian.
 */
#include <string.h>

#include "checksum.h"
#include "instance.h"

#define STATE_VERSION 1u
#define HEAD 24u
#define CHECKED 16u /* place of the first byte that the checksum is of */

static const char MAGIC[4] = {'R', 'C', 'S', 'N'};

size_t rc_state_size(const rc_model *model)
{
    return model->state_size;
}

void rc_save(const rc_model *model, void *state)
{
    memcpy(state, model->state, model->state_size);
}

rc_status rc_restore(rc_model *model, const void *state)
{
    const unsigned char *saved = state;
    rc_head head;
    memcpy(&head, saved, sizeof head);
    if (head.phase < RC_INSTANTIATED || head.phase > RC_STEPPING)
        return rc_fail(model, RC_ERROR, "these bytes are not a state of this instance");
    memcpy(model->state, saved, model->state_size);
    for (size_t i = 1; i <= model->text_count; ++i)
        model->texts[RC_TEXT_SIZE * i - 1] = '\0'; /* whatever the bytes are */
    memset(model->known, 0, model->kind->kind_count);
    model->stepped = 0;
    if (head.phase == RC_INSTANTIATED)
        return RC_OK;
    const rc_status status = rc_prepare(model);
    if (status != RC_OK) /* a table of the state's parameters is gone: to be initialised again */
        model->head->phase = RC_INSTANTIATED;
    return status;
}

size_t rc_serialised_size(const rc_model *model)
{
    return HEAD + model->state_size;
}

void rc_serialise(const rc_model *model, const void *state, void *bytes)
{
    unsigned char *to = bytes;
    const uint64_t size = model->state_size;
    const uint32_t version = STATE_VERSION;
    memcpy(to, MAGIC, sizeof MAGIC);
    memcpy(to + 4, &version, 4);
    memcpy(to + 8, &model->resource.checksum, 4);
    memcpy(to + 16, &size, 8);
    memcpy(to + HEAD, state, model->state_size);
    const uint32_t checksum = rc_checksum(to + CHECKED, HEAD - CHECKED + model->state_size);
    memcpy(to + 12, &checksum, 4);
}

/* Whether every Integer is one of 32 bits, as hosts get it, and every Boolean 0 or 1: a checksum
 * can be forged. */
static int whole_numbers_fit(const rc_model *model, const unsigned char *state)
{
    const unsigned char *values = state + ((const unsigned char *)model->values - model->state);
    for (size_t g = 0; g < model->kind->kind_count; ++g) {
        const rc_group *group = &model->groups[g];
        const int is_boolean = group->type == RC_BOOLEAN;
        if ((group->type != RC_INTEGER && !is_boolean) || group->causality == RC_OUTPUT)
            continue;
        for (size_t i = 0; i < group->count; ++i) {
            double value;
            memcpy(&value, values + (model->slots[g] + i) * sizeof value, sizeof value);
            if (!(value >= (is_boolean ? 0 : INT32_MIN) && value <= (is_boolean ? 1 : INT32_MAX)))
                return 0;
        }
    }
    return 1;
}

rc_status rc_deserialise(rc_model *model, const void *bytes, size_t size, void *state)
{
    const unsigned char *from = bytes;
    uint32_t version, identity, checksum;
    uint64_t said;
    if (size < HEAD || memcmp(from, MAGIC, sizeof MAGIC) != 0)
        return rc_fail(model, RC_ERROR, "these bytes are not a serialised state of a native %s",
                       model->kind->name);
    memcpy(&version, from + 4, 4);
    memcpy(&identity, from + 8, 4);
    memcpy(&checksum, from + 12, 4);
    memcpy(&said, from + 16, 8);
    if (version != STATE_VERSION)
        return rc_fail(model, RC_ERROR, "the serialised state has format %lu; this FMU reads %u",
                       (unsigned long)version, STATE_VERSION);
    if (identity != model->resource.checksum)
        return rc_fail(model, RC_ERROR, "the state was saved by another build of %s; use states "
                                        "of the same build only", model->kind->name);
    if (size != HEAD + model->state_size || said != model->state_size ||
        rc_checksum(from + CHECKED, size - CHECKED) != checksum ||
        !whole_numbers_fit(model, from + HEAD))
        return rc_fail(model, RC_ERROR,
                       "the serialised state is truncated or altered (%zu bytes, its checksum, "
                       "its size or a number is wrong)", size);
    memcpy(state, from + HEAD, model->state_size);
    return RC_OK;
}
