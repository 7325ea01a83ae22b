/* Steps that end at a switch of contact, for hosts that allow it. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "fmu.h"

#define CLOSE_ENOUGH 1e-9 /* s; how far behind the switch a step may end */
#define RESOLUTION (4.0 * DBL_EPSILON) /* of the time; what is shorter moves nothing on */
#define MOST_BISECTIONS 60

static void read_gaps(rc_fmu *fmu, double *gaps)
{
    (void)rc_get_group(fmu->model, (size_t)(fmu->gap - rc_group_at(fmu->model, 0)), gaps);
}

void rc_fmu_watch(rc_fmu *fmu)
{
    read_gaps(fmu, fmu->gaps);
    rc_save(fmu->model, fmu->start);
}

/* Whether a wheel lost or met the rail since the start of the step. */
static int has_switched(rc_fmu *fmu)
{
    read_gaps(fmu, fmu->gaps_now);
    for (uint32_t i = 0; i < fmu->gap->count; ++i)
        if ((fmu->gaps_now[i] > 0.0) != (fmu->gaps[i] > 0.0))
            return 1;
    return 0;
}

/* The step again, of this size only; inputs on straight lines are met on their way. */
static rc_status repeat(rc_fmu *fmu, double time, double part, double step)
{
    double linear;
    rc_status status = rc_restore(fmu->model, fmu->start);
    if (status == RC_OK)
        status = rc_get(fmu->model, RC_BOOLEAN, &fmu->linear_inputs, 1, &linear);
    if (status != RC_OK)
        return status;
    if (!fmu->head->sloped && linear != 0.0) {
        for (size_t i = 0; i < fmu->input_count; ++i)
            fmu->ends[i] = fmu->last[i] + part / step * (fmu->present[i] - fmu->last[i]);
        rc_fmu_write_inputs(fmu, fmu->ends);
    }
    return rc_fmu_step_once(fmu, time, part);
}

/* To the start of the step and to its inputs, of which a repetition that failed may have left some
 * half way. */
static rc_status go_back(rc_fmu *fmu, rc_status status)
{
    (void)rc_restore(fmu->model, fmu->start);
    return status;
}

rc_status rc_fmu_go_back_to_switch(rc_fmu *fmu, double time, double step, int *ended_early)
{
    const double close = fmax(CLOSE_ENOUGH, RESOLUTION * fabs(time));
    double before = 0.0, behind = step, tried = step;
    if (!has_switched(fmu))
        return RC_OK;
    for (int n = 0; n < MOST_BISECTIONS && behind - before > close; ++n) {
        tried = before + 0.5 * (behind - before);
        const rc_status status = repeat(fmu, time, tried, step);
        if (status != RC_OK)
            return go_back(fmu, status);
        if (has_switched(fmu))
            behind = tried;
        else
            before = tried;
    }
    const rc_status status = tried == behind ? RC_OK : repeat(fmu, time, behind, step);
    if (status != RC_OK)
        return go_back(fmu, status);
    *ended_early = behind < step;
    return RC_OK;
}
