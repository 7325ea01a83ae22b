#include "support_line.h"

#include <stdlib.h>
#include <string.h>

const rc_property_kind RC_PROPERTIES[RC_PROPERTY_COUNT] = {
    [RC_PAD_STIFFNESS_FACTOR] = {"pad_stiffness_factor", 1.0},
    [RC_PAD_DAMPING_FACTOR] = {"pad_damping_factor", 1.0},
    [RC_BALLAST_STIFFNESS_FACTOR] = {"ballast_stiffness_factor", 1.0},
    [RC_BALLAST_DAMPING_FACTOR] = {"ballast_damping_factor", 1.0},
    [RC_GAP] = {"gap", 0.0},
    [RC_FASTENED] = {"fastened", 1.0},
};

static const rc_support NOMINAL = {{
    [RC_PAD_STIFFNESS_FACTOR] = 1.0,
    [RC_PAD_DAMPING_FACTOR] = 1.0,
    [RC_BALLAST_STIFFNESS_FACTOR] = 1.0,
    [RC_BALLAST_DAMPING_FACTOR] = 1.0,
    [RC_GAP] = 0.0,
    [RC_FASTENED] = 1.0,
}};

const rc_support *rc_support_at(const rc_support_line *line, ptrdiff_t number)
{
    if (number < 0 || line->count == 0)
        return &NOMINAL;
    const size_t place = (size_t)number;
    if (place < line->count)
        return &line->known[place];
    return line->repeat ? &line->known[place % line->count] : &NOMINAL;
}

int rc_are_alike(const rc_support_line *line, rc_property first, rc_property end)
{
    for (size_t s = 0; s < line->count; ++s)
        for (size_t p = first; p < end; ++p)
            if (line->known[s].of[p] != RC_PROPERTIES[p].nominal)
                return 0;
    return 1;
}

int rc_claim_supports(rc_support_line *line, size_t count)
{
    line->known = malloc(count * sizeof *line->known);
    line->count = line->known == NULL ? 0 : count;
    for (size_t s = 0; s < line->count; ++s)
        line->known[s] = NOMINAL;
    return line->known != NULL;
}

void rc_free_supports(rc_support_line *line)
{
    free(line->known);
    memset(line, 0, sizeof *line);
}
