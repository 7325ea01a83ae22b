#include "draw.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* splitmix64 (Steele, Lea & Flood 2014) */
uint64_t draw_bits(draw *from)
{
    uint64_t z = from->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

size_t draw_below(draw *from, size_t end)
{
    return (size_t)(draw_bits(from) % end);
}

int draw_once_in(draw *from, size_t times)
{
    return draw_below(from, times) == 0;
}

double draw_share(draw *from)
{
    return (double)(draw_bits(from) >> 11) * 0x1p-53;
}

double draw_strange(draw *from)
{
    static const double strange[] = {0.0,      -0.0,     1.0,      -1.0,      5e-324,
                                     -1e-310,  1e-300,   1e300,    -1e300,    DBL_MAX,
                                     -DBL_MAX, INFINITY, -INFINITY, NAN};
    return strange[draw_below(from, sizeof strange / sizeof strange[0])];
}

double draw_near(draw *from, double usual)
{
    switch (draw_below(from, 8)) {
    case 0:
        return draw_strange(from);
    case 1:
        return -usual;
    case 2:
        return usual;
    default:
        return usual * (0.5 + draw_share(from));
    }
}

char *draw_text(draw *from)
{
    static const size_t lengths[] = {0, 1, 7, 60, 1022, 1023, 1024, 5000, 100000};
    const size_t length = lengths[draw_below(from, sizeof lengths / sizeof lengths[0])];
    char *text = malloc(length + 1);
    if (text == NULL)
        abort();
    for (size_t i = 0; i < length; ++i)
        text[i] = (char)(1 + draw_below(from, 255));
    if (draw_once_in(from, 2))
        memset(text, '%', length < 60 ? length : 60); /* a format, if it is taken for one */
    text[length] = '\0';
    return text;
}
