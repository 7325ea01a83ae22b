/* Slopes of inputs and outputs, directional and adjoint derivatives. */
#include <stdlib.h>

#include "request.h"

static void call_derivatives(school *at, pupil *of, request *unknowns, request *knowns)
{
    unsigned right = right_in(of, INITIALISING | STEPPING | TERMINATED);
    if (right == MAY_OK)
        right = MAY_OK | MAY_DISCARD;
    for (size_t i = 0; i < unknowns->list.count; ++i) {
        const rc_group *group = rc_group_of(at->model, unknowns->memory[i]);
        if (group == NULL || group->type != RC_REAL || group->causality != RC_OUTPUT)
            right = right == MAY_ERROR ? MAY_ERROR : MAY_ERROR | MAY_DISCARD;
    }
    for (size_t i = 0; i < knowns->list.count; ++i) {
        const rc_group *group = rc_group_of(at->model, knowns->memory[i]);
        if (group == NULL || group->type != RC_REAL || group->causality != RC_INPUT)
            right = right == MAY_ERROR ? MAY_ERROR : MAY_ERROR | MAY_DISCARD;
    }
    if (unknowns->faulty || knowns->faulty)
        right = MAY_ERROR;
    answer given;
    if (at->host->adjoin != NULL && draw_once_in(&at->draw, 3)) {
        if (knowns->list.count == 0 || unknowns->list.count == 0)
            right |= MAY_OK; /* a sum of nothing */
        for (size_t i = 0; i < unknowns->list.count; ++i)
            unknowns->list.values[i] = draw_near(&at->draw, 1.0);
        ask(at, of, "adjoint derivatives");
        given = at->host->adjoin(of->fmu, &unknowns->list, &knowns->list);
    } else {
        for (size_t i = 0; i < knowns->list.count; ++i)
            knowns->list.values[i] = draw_near(&at->draw, 1.0);
        ask(at, of, "directional derivatives");
        given = at->host->derive(of->fmu, &unknowns->list, &knowns->list);
    }
    judge(at, of, given, right);
}

void call_slopes(school *at, pupil *of)
{
    static const rc_causality input[] = {RC_INPUT}, output[] = {RC_OUTPUT};
    draw *from = &at->draw;
    const size_t count = draw_below(from, 4);
    request outputs = make_request(at, RC_REAL, output, 1, count);
    request inputs = make_request(at, RC_REAL, input, 1, draw_below(from, 4));
    const int setting = at->host->set_slopes != NULL && draw_once_in(from, 3);
    if (!setting && draw_once_in(from, 2)) {
        call_derivatives(at, of, &outputs, &inputs);
    } else {
        request *chosen = setting ? &inputs : &outputs;
        int32_t *orders = exact(chosen->list.count, sizeof *orders);
        const int missing = draw_once_in(from, 40) && chosen->list.count > 0;
        unsigned right =
            setting ? right_in(of, RUNNING) : right_in(of, at->host->version == 2
                                                               ? INITIALISING | STEPPING | TERMINATED
                                                               : STEPPING | TERMINATED);
        if (!setting && right == MAY_OK)
            right |= MAY_DISCARD | (of->is.phase == INITIALISING && of->is.touched ? MAY_ERROR : 0);
        for (size_t i = 0; i < chosen->list.count; ++i) {
            const rc_group *group = rc_group_of(at->model, chosen->memory[i]);
            orders[i] = draw_once_in(from, 12) ? (int32_t)draw_below(from, 4) - 1 : 1;
            if (group == NULL || group->type != RC_REAL || orders[i] != 1 ||
                group->causality != (setting ? RC_INPUT : RC_OUTPUT))
                right = right & MAY_DISCARD ? MAY_ERROR | MAY_DISCARD : MAY_ERROR;
            chosen->list.values[i] = draw_near(from, 0.1);
        }
        if (chosen->faulty || missing)
            right = MAY_ERROR;
        ask(at, of, setting ? "setting slopes" : "getting slopes");
        const answer given =
            setting ? at->host->set_slopes(of->fmu, &chosen->list, missing ? NULL : orders)
                    : at->host->get_slopes(of->fmu, &chosen->list, missing ? NULL : orders);
        judge(at, of, given, right);
        free(orders);
    }
    free_request(&outputs);
    free_request(&inputs);
}
