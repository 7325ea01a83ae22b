/* Damages the resource of a model, with a checksum that fits, and uses what is taken for good.
 *
 * A resource is refused with a sentence, or the instance made of it can be initialised, stepped,
 * saved and freed; its numbers may be anything.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "checksum.h"
#include "draw.h"
#include "model.h"
#include "resources.h"

#define HEAD 32u
#define ENTRY 48u

typedef struct {
    unsigned char *data;
    size_t size, sections;
} resource;

static void put(resource *of, size_t place, uint64_t value, size_t width)
{
    if (place + width <= of->size)
        memcpy(of->data + place, &value, width);
}

/* A number that an integer field may be misread from. */
static uint64_t draw_whole(draw *from)
{
    static const uint64_t edges[] = {0,       1,          2,          7,        8,
                                     64,      10000,      10001,      1000000,  1000001,
                                     1u << 31, 0xFFFFFFFF, 1ull << 61, 1ull << 63, ~0ull};
    return draw_once_in(from, 2) ? edges[draw_below(from, sizeof edges / sizeof edges[0])]
                                 : draw_below(from, 300);
}

static void alter_contents(resource *of, draw *from)
{
    static const size_t fields[][2] = {{0, 1}, {24, 4}, {32, 8}, {40, 8}};
    const size_t *field = fields[draw_below(from, 4)];
    const size_t entry = HEAD + ENTRY * draw_below(from, of->sections);
    const uint64_t value = draw_whole(from);
    put(of, entry + field[0], field[0] == 32 ? value * 64 : value, field[1]);
}

/* Where a section begins and how many values it says it has. */
static void find(const resource *of, const char *name, uint64_t *place, uint64_t *count)
{
    *place = *count = 0;
    for (size_t i = 0; i < of->sections; ++i) {
        const unsigned char *entry = of->data + HEAD + ENTRY * i;
        if (strcmp((const char *)entry, name) != 0)
            continue;
        memcpy(place, entry + 32, 8);
        memcpy(count, entry + 40, 8);
    }
}

static void alter_values(resource *of, const resource *good, draw *from)
{
    static const char *const names[] = {"structure", "numbers", "eigenvalues", "inverses", "weight",
                                        "shape", "flexibility", "start", "sleeper_shape",
                                        "inertia", "sleeper_mass", "sleeper_bed", "bent_shape",
                                        "bent_flexibility"};
    uint64_t place, count;
    const size_t chosen = draw_below(from, sizeof names / sizeof names[0]);
    find(good, names[chosen], &place, &count);
    if (count == 0)
        return;
    uint64_t bits = draw_whole(from);
    const double value = draw_strange(from);
    if (chosen > 0)
        memcpy(&bits, &value, 8);
    put(of, place + 8 * draw_below(from, (size_t)count), bits, 8);
}

static void alter(resource *of, const resource *good, draw *from)
{
    switch (draw_below(from, 5)) {
    case 0:
        alter_contents(of, from);
        break;
    case 1:
    case 2:
        alter_values(of, good, from);
        break;
    case 3:
        of->data[HEAD + draw_below(from, of->size - HEAD)] ^= (unsigned char)draw_bits(from);
        break;
    default:
        of->data[HEAD + draw_below(from, 1024 < of->size ? 1024 - HEAD : of->size - HEAD)] =
            (unsigned char)draw_bits(from);
    }
    put(of, 16, of->size, 8);
    put(of, 24, rc_checksum(of->data + HEAD, of->size - HEAD), 4);
}

static void use(rc_model *model)
{
    double reached, *values = calloc(rc_variable_count(model) + 1u, sizeof *values);
    unsigned char *state = malloc(rc_state_size(model));
    if (values == NULL || state == NULL)
        abort();
    if (rc_enter_initialisation(model, 0.0) == RC_OK && rc_exit_initialisation(model) == RC_OK)
        for (int step = 0; step < 3; ++step) {
            rc_save(model, state);
            if (rc_step(model, rc_time(model), 1e-4, RC_AS_PARAMETER, &reached) != RC_OK)
                (void)rc_restore(model, state);
            for (size_t g = 0; g < rc_group_count(model); ++g)
                (void)rc_get_group(model, g, values);
        }
    rc_reset(model);
    free(values);
    free(state);
}

/* Another resource from a good one; its data are for free(). */
static resource spoil(const resource *good, draw *from)
{
    resource bad = *good;
    if (draw_once_in(from, 10))
        bad.size = HEAD + 1 + draw_below(from, good->size - HEAD - 1);
    bad.data = malloc(bad.size);
    if (bad.data == NULL)
        abort();
    memcpy(bad.data, good->data, bad.size);
    for (size_t i = 1 + draw_below(from, 3); i > 0; --i)
        alter(&bad, good, from);
    return bad;
}

int fuzz_resources(uint64_t seed, unsigned long rounds, unsigned char *data, size_t size)
{
    draw from = {seed};
    uint32_t sections;
    unsigned long taken = 0;
    memcpy(&sections, data + 12, 4);
    const resource good = {data, size, sections};
    for (unsigned long round = 0; round < rounds; ++round) {
        char message[RC_MESSAGE_SIZE] = "";
        const resource bad = spoil(&good, &from);
        rc_model *model = rc_create(rc_library_class(), bad.data, bad.size, message);
        if (model == NULL && message[0] == '\0') {
            fprintf(stderr, "seed %llu, round %lu: a resource is refused without a sentence\n",
                    (unsigned long long)seed, round);
            return 1;
        }
        if (model != NULL) {
            ++taken;
            use(model);
        }
        rc_destroy(model);
        free(bad.data);
    }
    printf("%lu resources: %lu refused, %lu used\n", rounds, rounds - taken, taken);
    return 0;
}
