/* CRC-32 as of zlib. */
#ifndef RC_CHECKSUM_H
#define RC_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

uint32_t rc_checksum(const void *data, size_t size);

#endif
