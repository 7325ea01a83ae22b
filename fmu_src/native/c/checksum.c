#include "checksum.h"

#define POLYNOMIAL 0xEDB88320u
#define SLICES 8

/* tables[k][b]: the checksum of byte b followed by k zero bytes */
static void fill_tables(uint32_t tables[SLICES][256])
{
    for (uint32_t byte = 0; byte < 256; ++byte) {
        uint32_t value = byte;
        for (int bit = 0; bit < 8; ++bit)
            value = (value >> 1) ^ (POLYNOMIAL & (0u - (value & 1u)));
        tables[0][byte] = value;
    }
    for (int slice = 1; slice < SLICES; ++slice)
        for (int byte = 0; byte < 256; ++byte) {
            uint32_t before = tables[slice - 1][byte];
            tables[slice][byte] = (before >> 8) ^ tables[0][before & 0xFFu];
        }
}

uint32_t rc_checksum(const void *data, size_t size)
{
    uint32_t tables[SLICES][256]; /* on the stack: 16000 operations, and nothing to share */
    const unsigned char *byte = data;
    uint32_t value = 0xFFFFFFFFu;
    fill_tables(tables);
    for (; size >= SLICES; size -= SLICES, byte += SLICES) {
        value ^= (uint32_t)byte[0] | (uint32_t)byte[1] << 8 | (uint32_t)byte[2] << 16 |
                 (uint32_t)byte[3] << 24;
        value = tables[7][value & 0xFFu] ^ tables[6][(value >> 8) & 0xFFu] ^
                tables[5][(value >> 16) & 0xFFu] ^ tables[4][value >> 24] ^ tables[3][byte[4]] ^
                tables[2][byte[5]] ^ tables[1][byte[6]] ^ tables[0][byte[7]];
    }
    for (; size > 0; --size, ++byte)
        value = (value >> 8) ^ tables[0][(value ^ *byte) & 0xFFu];
    return value ^ 0xFFFFFFFFu;
}
