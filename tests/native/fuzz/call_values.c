/* Variables are read and set, by good and by bad references. */
#include <stdlib.h>
#include <string.h>

#include "request.h"
#include "tables.h"

static int is_time(const school *at, rc_type type, uint32_t variable)
{
    return at->host->has_time && type == RC_REAL && variable == at->variables;
}

static size_t draw_count(school *at)
{
    return draw_once_in(&at->draw, 50) ? 2 * at->variables : draw_below(&at->draw, 5);
}

static void get_values(school *at, pupil *of, rc_type type)
{
    static const rc_causality all[] = {RC_CONSTANT, RC_PARAMETER, RC_INPUT, RC_OUTPUT};
    request made = make_request(at, type, all, 4, draw_count(at));
    unsigned right = right_in(of, ANY);
    for (size_t i = 0; i < made.list.count && right != MAY_ERROR; ++i) {
        const rc_group *group = rc_group_of(at->model, made.memory[i]);
        if (is_time(at, type, made.memory[i]))
            continue;
        if (group == NULL || group->type != type)
            right = MAY_ERROR;
        else if (group->causality == RC_OUTPUT && of->is.phase == INITIALISING && of->is.touched)
            right |= MAY_ERROR;
    }
    ask(at, of, "getting values");
    const answer given = at->host->get(of->fmu, type, &made.list);
    judge(at, of, given, made.faulty ? MAY_ERROR : right);
    for (size_t i = 0; given == OK && type == RC_TEXT && i < made.list.count; ++i)
        if (made.list.texts[i] == NULL || strlen(made.list.texts[i]) >= RC_TEXT_SIZE)
            blame(at, "text %zu is none", i + 1);
    free_request(&made);
}

/* What is usual for a variable whose start value is zero. */
static double order_of(const char *name)
{
    static const struct {
        const char *part;
        double order;
    } all[] = {{"force", 1e5},     {"load_change", 1e4}, {"position", 3.0},  {"velocity", 1e-2},
               {"mass", 100.0},    {"stiffness", 1e7},   {"damping", 1e4},   {"clearance", 1e-4}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i)
        if (strstr(name, all[i].part) != NULL)
            return all[i].order;
    return 1e-3;
}

/* A value for a variable: near its start value, or strange. */
static double draw_value(school *at, rc_type type, uint32_t variable)
{
    double usual = 0.0;
    draw *from = &at->draw;
    const rc_group *group = rc_group_of(at->model, variable);
    if (group == NULL || group->causality == RC_OUTPUT || group->type != type)
        return type == RC_REAL ? draw_strange(from) : (double)draw_below(from, 3);
    (void)rc_get(at->model, type, &variable, 1, &usual);
    if (type == RC_BOOLEAN) /* to roll a flat takes 4 million operations */
        return draw_once_in(from, strcmp(group->name, "flat.rolled") == 0 ? 200 : 2);
    if (type == RC_INTEGER)
        return draw_once_in(from, 4) ? (double)(int32_t)draw_bits(from)
                                     : usual + (double)draw_below(from, 3) - 1.0;
    if (usual == 0.0)
        usual = order_of(group->name);
    if (group->causality == RC_INPUT && strstr(group->name, "position") != NULL &&
        draw_once_in(from, 3))
        return usual + 6.0 * (draw_share(from) - 0.5); /* the window of an endless track follows */
    return draw_once_in(from, 6) ? draw_near(from, usual) : usual * (0.9 + 0.2 * draw_share(from));
}

/* A table of the kind that a parameter takes, or any. */
static const char *choose_table(school *at, uint32_t variable)
{
    const rc_group *group = rc_group_of(at->model, variable);
    const char *name = group == NULL ? "" : group->name;
    const table_kind kind = strcmp(name, "supports") == 0     ? SUPPORT_TABLE
                            : strcmp(name, "pad") == 0        ? PAD_TABLE
                            : strcmp(name, "flat.shape") == 0 ? PROFILE_TABLE
                                                              : SERIES_TABLE;
    return at->tables[draw_once_in(&at->draw, 4)
                          ? draw_below(&at->draw, TABLES)
                          : (size_t)kind + TABLE_KINDS * draw_below(&at->draw, 2)];
}

static const char *choose_text(school *at, uint32_t variable, const char *own)
{
    static const char *const words[] = {"linear",   "state_dependent", "hyperbolic", "none", "cusp",
                                        "haversine", "parabola",       "chord",      "",
                                        "suspended", "masses"};
    draw *from = &at->draw;
    switch (draw_below(from, 4)) {
    case 0:
        return own;
    case 1:
    case 2:
        return choose_table(at, variable);
    default:
        return words[draw_below(from, sizeof words / sizeof words[0])];
    }
}

/* What set a parameter, or an input before the first step, may spoil the initialisation. */
static void note_change(school *at, pupil *of, const request *made)
{
    for (size_t i = 0; i < made->list.count; ++i) {
        const rc_group *group = rc_group_of(at->model, made->memory[i]);
        if (group != NULL && (group->causality != RC_INPUT || of->is.phase != STEPPING))
            of->is.touched = 1;
    }
}

static void check_taken(school *at, pupil *of, const request *made)
{
    list back = made->list;
    back.values = exact(back.count, sizeof(double));
    ask(at, of, "getting what was set");
    judge(at, of, at->host->get(of->fmu, RC_REAL, &back), MAY_OK);
    for (size_t i = 0; i < back.count; ++i) {
        size_t last = i; /* the last of equal references counts */
        for (size_t k = i + 1; k < back.count; ++k)
            if (made->memory[k] == made->memory[i])
                last = k;
        if (memcmp(&back.values[i], &made->list.values[last], sizeof(double)) != 0)
            blame(at, "variable %lu is %g, not %g", (unsigned long)made->memory[i], back.values[i],
                  made->list.values[last]);
    }
    free(back.values);
}

static void set_values(school *at, pupil *of, rc_type type)
{
    static const rc_causality settable[] = {RC_INPUT, RC_PARAMETER};
    const size_t choices = of->is.phase & (CREATED | INITIALISING) ? 2 : 1 + (size_t)draw_once_in(&at->draw, 10);
    request made = make_request(at, type, settable, choices, draw_count(at));
    char *text = type == RC_TEXT ? draw_text(&at->draw) : NULL;
    unsigned right = right_in(of, RUNNING);
    for (size_t i = 0; i < made.list.count; ++i) {
        const rc_group *group = rc_group_of(at->model, made.memory[i]);
        if (group == NULL || group->type != type || group->causality == RC_OUTPUT ||
            group->causality == RC_CONSTANT ||
            (group->causality == RC_PARAMETER &&
             !(of->is.phase & (CREATED | INITIALISING))))
            right = MAY_ERROR;
        if (type != RC_TEXT) {
            made.list.values[i] = draw_value(at, type, made.memory[i]);
            continue;
        }
        made.list.texts[i] = draw_once_in(&at->draw, 30) ? NULL : choose_text(at, made.memory[i], text);
        if (made.list.texts[i] == NULL || strlen(made.list.texts[i]) >= RC_TEXT_SIZE)
            right = MAY_ERROR;
    }
    ask(at, of, "setting values");
    const answer given = at->host->set(of->fmu, type, &made.list);
    judge(at, of, given, made.faulty ? MAY_ERROR : right);
    if (given == OK || type != RC_REAL)
        note_change(at, of, &made);
    if (given == OK && type == RC_REAL && of->fmu != NULL && made.list.said == made.list.count)
        check_taken(at, of, &made);
    free(text);
    free_request(&made);
}

void call_values(school *at, pupil *of)
{
    static const rc_type types[] = {RC_REAL, RC_REAL, RC_REAL, RC_INTEGER, RC_BOOLEAN, RC_TEXT};
    const rc_type type = types[draw_below(&at->draw, sizeof types / sizeof types[0])];
    if (draw_once_in(&at->draw, 2))
        get_values(at, of, type);
    else
        set_values(at, of, type);
}
