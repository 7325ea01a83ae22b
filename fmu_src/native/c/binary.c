#include "binary.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "checksum.h"

#define HEAD 32u
#define ENTRY 48u
#define NAME 24u
#define ALIGNMENT 64u

static const char MAGIC[8] = {'R', 'A', 'I', 'L', 'C', 'O', 'S', 'M'};

static uint32_t u32_at(const unsigned char *place)
{
    uint32_t value;
    memcpy(&value, place, sizeof value);
    return value;
}

static uint64_t u64_at(const unsigned char *place)
{
    uint64_t value;
    memcpy(&value, place, sizeof value);
    return value;
}

static size_t width(uint32_t type)
{
    return type == RC_BYTES ? 1u : 8u;
}

static int little_endian(void)
{
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first == 1;
}

/* Whether every section lies within the data and is what it says. */
static int sections_fit(const rc_resource *resource)
{
    const uint64_t size = resource->size;
    if (resource->sections > (size - HEAD) / ENTRY)
        return 0;
    const uint64_t least = HEAD + (uint64_t)ENTRY * resource->sections;
    for (uint32_t i = 0; i < resource->sections; ++i) {
        const unsigned char *entry = resource->data + HEAD + (size_t)ENTRY * i;
        const uint32_t type = u32_at(entry + NAME);
        const uint64_t place = u64_at(entry + 32), count = u64_at(entry + 40);
        if (type < RC_FLOAT64 || type > RC_BYTES || entry[NAME - 1] != 0)
            return 0;
        if (place % ALIGNMENT != 0 || place < least || place > size)
            return 0;
        if (count > (size - place) / width(type))
            return 0;
    }
    return 1;
}

int rc_open_resource(rc_resource *resource, const void *data, size_t size, char *message,
                     size_t room)
{
    const unsigned char *bytes = data;
    if (!little_endian()) {
        snprintf(message, room, "this machine stores numbers big end first; the resource of the "
                                "model is for little-endian machines only");
        return 0;
    }
    if (bytes == NULL || size < HEAD || memcmp(bytes, MAGIC, sizeof MAGIC) != 0) {
        snprintf(message, room, "the resource is not one of this project (%zu bytes, no mark at "
                                "its beginning); build the FMU again", size);
        return 0;
    }
    if ((uintptr_t)bytes % 8u != 0) {
        snprintf(message, room, "the resource must be aligned to 8 bytes in memory");
        return 0;
    }
    const uint32_t version = u32_at(bytes + 8);
    if (version != RC_RESOURCE_VERSION) {
        snprintf(message, room, "the resource has format %" PRIu32 "; this program reads %u: "
                                "build the FMU again", version, RC_RESOURCE_VERSION);
        return 0;
    }
    const uint64_t said = u64_at(bytes + 16);
    if (said != size) {
        snprintf(message, room, "the resource has %zu bytes and says it has %" PRIu64 "; it is "
                                "truncated or altered: unpack or build the FMU again", size, said);
        return 0;
    }
    resource->data = bytes;
    resource->size = size;
    resource->sections = u32_at(bytes + 12);
    resource->checksum = u32_at(bytes + 24);
    if (rc_checksum(bytes + HEAD, size - HEAD) != resource->checksum ||
        u32_at(bytes + 28) != 0 || !sections_fit(resource)) {
        snprintf(message, room, "the resource is damaged (its checksum or its table of contents "
                                "is wrong); unpack or build the FMU again");
        return 0;
    }
    return 1;
}

const void *rc_find_section(const rc_resource *resource, const char *name, rc_section_type type,
                            size_t *count)
{
    for (uint32_t i = 0; i < resource->sections; ++i) {
        const unsigned char *entry = resource->data + HEAD + (size_t)ENTRY * i;
        if (strncmp((const char *)entry, name, NAME) == 0 && u32_at(entry + NAME) == type) {
            *count = (size_t)u64_at(entry + 40);
            return resource->data + (size_t)u64_at(entry + 32);
        }
    }
    *count = 0;
    return NULL;
}
