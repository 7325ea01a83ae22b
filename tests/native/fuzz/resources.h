/* Damaged resources. */
#ifndef FUZZ_RESOURCES_H
#define FUZZ_RESOURCES_H

#include <stddef.h>
#include <stdint.h>

/* Makes models of so many resources that are damaged ones of the good one in `data`; 0, or 1 and a
 * sentence where a model refuses one without a sentence. */
int fuzz_resources(uint64_t seed, unsigned long rounds, unsigned char *data, size_t size);

#endif
