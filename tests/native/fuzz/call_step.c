/* Steps: good ones, impossible ones, and one taken twice from the same state. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "school.h"

#define TOLERANCE 1e-9 /* of the time where a step begins, relative */

static double draw_size(draw *from)
{
    static const double sizes[] = {1e-4, 1e-4, 2e-4, 1e-3, 1.3e-3, 1e-6, 1e-12, 5e-324};
    switch (draw_below(from, 12)) {
    case 0:
        return draw_once_in(from, 2) ? draw_strange(from) : -1e-4;
    case 1:
        return draw_once_in(from, 8) ? 1e14 : 0.02; /* what lies between takes long */
    case 2:
    case 3:
        return 2e-3 * draw_share(from);
    default:
        return sizes[draw_below(from, sizeof sizes / sizeof sizes[0])];
    }
}

/* Takes a step and judges the answer; whether it was taken. */
static int take(school *at, pupil *of, double time, double step, int without)
{
    const knowledge *is = &of->is;
    double reached = NAN;
    int early = 0;
    unsigned right = right_in(of, STEPPING);
    const int without_result = at->host->version == 3 && without != 0;
    if (right == MAY_OK) {
        const double larger = fmax(fabs(time), fabs(is->time));
        const int joins = fabs(time - is->time) <= fmax(TOLERANCE * larger, 1e-12);
        const int possible =
            joins && isfinite(step) && time + step > time && inputs_are_finite(at, of);
        right = possible ? MAY_OK | MAY_DISCARD | MAY_WARN : MAY_DISCARD;
    }
    if (without_result)
        right = MAY_ERROR;
    ask(at, of, "stepping");
    const answer given = at->host->step(of->fmu, time, step, without, &reached, &early);
    judge(at, of, given, right);
    if (of->fmu == NULL || is->tainted)
        return 0;
    if (early && (!of->early_return || given != OK))
        blame(at, "returned early, which it must not");
    if (is->phase == STEPPING && !without_result) {
        if (given == OK && !early && reached != time + step)
            blame(at, "reached %.17g s from %.17g s in a step of %g s", reached, time, step);
        if (given == OK && early && !(reached >= time && reached <= time + step))
            blame(at, "returned early at %.17g s", reached);
        if (given == DISCARD && reached != is->time)
            blame(at, "discarded a step and went to %.17g s from %.17g s", reached, is->time);
    }
    if (given == OK)
        of->is.time = reached;
    return given == OK;
}

/* The same step from the same state ends the same, bit for bit. */
static void step_twice(school *at, pupil *of, double step)
{
    void *state = NULL;
    ask(at, of, "saving before a step");
    judge(at, of, at->host->save(of->fmu, &state), MAY_OK);
    const knowledge before = of->is;
    knowledge after = before;
    after.spoilt = at->spoilt;
    const int taken = take(at, of, before.time, step, 0);
    const double reached = of->is.time;
    after.known = read_outputs(at, of, after.outputs);
    ask(at, of, "going back before the step");
    judge(at, of, at->host->restore(of->fmu, state), MAY_OK);
    of->is = before;
    if (take(at, of, before.time, step, 0) != taken || of->is.time != reached)
        blame(at, "the step was %s before", taken ? "taken" : "refused");
    compare(at, of, &after);
    ask(at, of, "freeing the state before the step");
    judge(at, of, at->host->forget(of->fmu, &state), MAY_OK);
}

void call_step(school *at, pupil *of)
{
    draw *from = &at->draw;
    double outputs[MOST_OUTPUTS];
    double time = of->is.time, step = draw_size(from);
    if (of->fmu == NULL || of->is.phase != STEPPING) {
        (void)take(at, of, time, step, 0);
        return;
    }
    if (draw_once_in(from, 12))
        time = draw_once_in(from, 2) ? draw_strange(from) : time + 1e-4;
    else if (draw_once_in(from, 20))
        time += 1e-13;
    if (!of->is.tainted && draw_once_in(from, 8)) {
        step_twice(at, of, step);
        return;
    }
    const int without = draw_once_in(from, 30) ? (int)(1u << draw_below(from, 4)) : 0;
    if (take(at, of, time, step, without) && !draw_once_in(from, 4))
        (void)read_outputs(at, of, outputs);
}
