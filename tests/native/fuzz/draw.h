/* Random arguments: reproducible from a seed, on every machine. */
#ifndef FUZZ_DRAW_H
#define FUZZ_DRAW_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint64_t state;
} draw;

uint64_t draw_bits(draw *from);

/* A number below `end`, which is above zero. */
size_t draw_below(draw *from, size_t end);

/* Whether a thing that happens once in `times` happens now. */
int draw_once_in(draw *from, size_t times);

/* In [0, 1). */
double draw_share(draw *from);

/* No number, infinite, denormal, zero or huge: never anything ordinary. */
double draw_strange(draw *from);

/* `usual`, something near it or something strange. */
double draw_near(draw *from, double usual);

/* A text of any length and any bytes, in memory of its own for free(). */
char *draw_text(draw *from);

#endif
