/* The resource of a model: named arrays in one checked block of bytes.
 *
 * Little-endian. A head of 32 bytes:
 *
 *     0  char[8]  "RAILCOSM"
 *     8  u32      format version, RC_RESOURCE_VERSION
 *    12  u32      number of sections
 *    16  u64      size of everything [bytes]
 *    24  u32      CRC-32 of everything from byte 32 on
 *    28  u32      0
 *
 * then for every section 48 bytes
 *
 *     0  char[24] name, filled with zeros
 *    24  u32      type: 1 float64, 2 int64, 3 bytes
 *    28  u32      0
 *    32  u64      place of its first byte from the beginning, a multiple of 64
 *    40  u64      number of values
 *
 * and then the values, with zeros between the sections.
 */
#ifndef RC_BINARY_H
#define RC_BINARY_H

#include <stddef.h>
#include <stdint.h>

#define RC_RESOURCE_VERSION 1u

typedef enum { RC_FLOAT64 = 1, RC_INT64 = 2, RC_BYTES = 3 } rc_section_type;

typedef struct {
    const unsigned char *data;
    size_t size;
    uint32_t sections;
    uint32_t checksum; /* also the identity of the model's build */
} rc_resource;

/* Checks everything but the meaning; 0 and a sentence in `message` (`room` bytes) if it is wrong.
 * The data are not copied. */
int rc_open_resource(rc_resource *resource, const void *data, size_t size, char *message,
                     size_t room);

/* The values of a section, and their number; NULL if there is no such section of that type. */
const void *rc_find_section(const rc_resource *resource, const char *name, rc_section_type type,
                            size_t *count);

#endif
