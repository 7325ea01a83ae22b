/* Parameters that a whole model depends on, which random values would rarely meet together. */
#include <string.h>

#include "school.h"

typedef struct {
    const char *name; /* of a group */
    rc_type type;
    double value;
    const char *text;
} wish;

static const wish WISHES[] = {
    {"endless", RC_BOOLEAN, 1.0, NULL},
    {"endless", RC_BOOLEAN, 1.0, NULL}, /* as often as two others */
    {"supports_repeat", RC_BOOLEAN, 1.0, NULL},
    {"ballast_pulls", RC_BOOLEAN, 0.0, NULL},
    {"ballast_tangent_damping", RC_BOOLEAN, 1.0, NULL},
    {"ballast_mass", RC_REAL, 60.0, NULL},
    {"ballast_mass_grows", RC_BOOLEAN, 1.0, NULL},
    {"ballast", RC_TEXT, 0.0, "hyperbolic"},
    {"support[#].gap", RC_REAL, 3e-4, NULL},
    {"support[#].fastened", RC_BOOLEAN, 0.0, NULL},
    {"support[#].sleeper_mass_factor", RC_REAL, 0.6, NULL},
    {"model", RC_TEXT, 0.0, "suspended"},
    {"tread.mass", RC_REAL, 200.0, NULL},
    {"tread.stiffness", RC_REAL, 1e9, NULL},
    {"primary.clearance", RC_REAL, 1e-5, NULL},
    {"primary.stop_stiffness", RC_REAL, 1e7, NULL},
    {"flat.periodic", RC_BOOLEAN, 1.0, NULL},
};
#define WISH_COUNT (sizeof WISHES / sizeof WISHES[0])

static const rc_group *find(const rc_model *model, const wish *one)
{
    for (size_t g = 0; g < rc_group_count(model); ++g) {
        const rc_group *group = rc_group_at(model, g);
        if (strcmp(group->name, one->name) == 0 && group->type == one->type &&
            group->causality == RC_PARAMETER && group->count > 0)
            return group;
    }
    return NULL;
}

static void fulfil(school *at, pupil *of, const wish *one)
{
    const rc_group *group = find(at->model, one);
    if (group == NULL)
        return;
    uint32_t variable = group->first + (uint32_t)draw_below(&at->draw, group->count);
    double value = one->value;
    const char *text = one->text;
    const list made = {.variables = &variable, .count = 1, .said = 1, .values = &value, .texts = &text};
    ask(at, of, "setting a parameter");
    judge(at, of, at->host->set(of->fmu, one->type, &made), MAY_OK);
    of->is.touched = 1;
}

void make_wishes(school *at, pupil *of)
{
    for (size_t i = draw_below(&at->draw, 7); i > 0; --i)
        fulfil(at, of, &WISHES[draw_below(&at->draw, WISH_COUNT)]);
}
