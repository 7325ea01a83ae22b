#include "request.h"

#include <stdlib.h>

static uint32_t draw_variable(school *at)
{
    draw *from = &at->draw;
    switch (draw_below(from, 16)) {
    case 0:
        return (uint32_t)draw_bits(from);
    case 1:
        return at->variables + (uint32_t)draw_below(from, 2);
    default: {
        if (draw_once_in(from, 2))
            return (uint32_t)draw_below(from, at->variables);
        /* few would be parameters of a whole track, which has hundreds of others */
        const rc_group *group = rc_group_at(at->model, draw_below(from, rc_group_count(at->model)));
        return group->first + (uint32_t)draw_below(from, group->count > 0 ? group->count : 1);
    }
    }
}

/* A variable of a causality; any if there is none of it soon. */
static uint32_t draw_of(school *at, rc_type type, rc_causality causality)
{
    uint32_t variable = 0;
    for (int i = 0; i < 200; ++i) {
        variable = draw_variable(at);
        const rc_group *group = rc_group_of(at->model, variable);
        if (group != NULL && group->type == type && group->causality == causality)
            break;
    }
    return variable;
}

request make_request(school *at, rc_type type, const rc_causality *of, size_t causalities,
                     size_t count)
{
    draw *from = &at->draw;
    request made = {.list = {.count = count, .said = count}};
    made.memory = exact(count, sizeof *made.memory);
    made.list.values = exact(count, sizeof(double));
    made.list.texts = exact(count, sizeof(char *));
    made.list.variables = made.memory;
    const int strays = draw_once_in(from, 8);
    for (size_t i = 0; i < count; ++i)
        made.memory[i] = strays && draw_once_in(from, 4)
                             ? draw_variable(at)
                             : draw_of(at, type, of[draw_below(from, causalities)]);
    if (draw_once_in(from, 40)) {
        made.list.variables = NULL;
        made.faulty = count > 0;
    }
    if (draw_once_in(from, 40)) {
        made.list.no_values = 1;
        made.faulty |= count > 0;
    }
    if (draw_once_in(from, 40)) {
        made.list.said = draw_below(from, count + 3); /* never more than there is and one too few */
        made.faulty |= at->host->version == 3 && made.list.said != count;
    }
    return made;
}

void free_request(request *made)
{
    free(made->memory);
    free(made->list.values);
    free((void *)made->list.texts);
}
