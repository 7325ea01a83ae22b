/* Steps of an FMU's instance, slopes of its inputs and outputs. */
#include <string.h>

#include "fmu.h"

/* All inputs, group after group. */
static void read_inputs(rc_fmu *fmu, double *values)
{
    const rc_group *first = rc_group_at(fmu->model, 0);
    for (size_t g = 0; g < fmu->input_groups; ++g) {
        (void)rc_get_group(fmu->model, (size_t)(fmu->inputs - first) + g, values);
        values += fmu->inputs[g].count;
    }
}

void rc_fmu_write_inputs(rc_fmu *fmu, const double *values)
{
    const rc_group *first = rc_group_at(fmu->model, 0);
    for (size_t g = 0; g < fmu->input_groups; ++g) {
        (void)rc_set_group(fmu->model, (size_t)(fmu->inputs - first) + g, values);
        values += fmu->inputs[g].count;
    }
}

rc_status rc_fmu_exit(rc_fmu *fmu)
{
    const rc_status status = rc_fmu_pass(fmu, rc_exit_initialisation(fmu->model));
    if (status == RC_OK)
        read_inputs(fmu, fmu->last);
    return status;
}

rc_status rc_fmu_set_slope(rc_fmu *fmu, uint32_t variable, int32_t order, double slope)
{
    const rc_group *group = rc_group_of(fmu->model, variable);
    if (group == NULL || group->causality != RC_INPUT || group->type != RC_REAL)
        return rc_fmu_refuse(fmu, RC_ERROR, "variable %lu is no Real input",
                             (unsigned long)variable);
    if (order != 1)
        return rc_fmu_refuse(fmu, RC_ERROR, "derivative %ld of an input cannot be set; only the "
                                            "first is used", (long)order);
    fmu->slopes[variable - fmu->inputs->first] = slope;
    fmu->head->sloped = 1;
    return RC_OK;
}

rc_status rc_fmu_output_slope(rc_fmu *fmu, uint32_t variable, int32_t order, double *slope)
{
    static const struct {
        const char *of, *is;
    } KNOWN[] = {{"wheel[#].rail_displacement", "wheel[#].rail_velocity"},
                 {"wheel[#].displacement", "wheel[#].velocity"}};
    const rc_group *group = rc_group_of(fmu->model, variable);
    if (group == NULL || group->causality != RC_OUTPUT || group->type != RC_REAL)
        return rc_fmu_refuse(fmu, RC_ERROR, "variable %lu is no Real output",
                             (unsigned long)variable);
    if (order != 1)
        return rc_fmu_refuse(fmu, RC_ERROR, "derivative %ld of an output is not known, only the "
                                            "first", (long)order);
    for (size_t k = 0; k < sizeof KNOWN / sizeof KNOWN[0]; ++k) {
        if (strcmp(group->name, KNOWN[k].of) != 0)
            continue;
        for (size_t g = 0; g < rc_group_count(fmu->model); ++g) {
            const rc_group *other = rc_group_at(fmu->model, g);
            const uint32_t number = other->first + variable - group->first;
            if (strcmp(other->name, KNOWN[k].is) == 0)
                return rc_fmu_pass(fmu, rc_get(fmu->model, RC_REAL, &number, 1, slope));
        }
    }
    char name[64];
    (void)rc_name(fmu->model, variable, name, sizeof name);
    return rc_fmu_refuse(fmu, RC_DISCARD, "the derivative of %s is not known", name);
}

rc_status rc_fmu_step_once(rc_fmu *fmu, double time, double step)
{
    rc_status status = RC_OK;
    if (!fmu->head->sloped)
        return rc_step(fmu->model, time, step, RC_AS_PARAMETER, &fmu->head->reached);
    for (size_t i = 0; i < fmu->input_count; ++i)
        fmu->ends[i] = fmu->present[i] + step * fmu->slopes[i];
    const int jumps =
        memcmp(fmu->present, fmu->last, fmu->input_count * sizeof(double)) != 0;
    if (jumps) {
        rc_save(fmu->model, fmu->before);
        status = rc_jump(fmu->model);
    }
    rc_fmu_write_inputs(fmu, fmu->ends);
    if (status == RC_OK)
        status = rc_step(fmu->model, time, step, RC_STRAIGHT, &fmu->head->reached);
    if (status != RC_OK) {
        if (jumps)
            (void)rc_restore(fmu->model, fmu->before);
        rc_fmu_write_inputs(fmu, fmu->present);
    }
    return status;
}

rc_status rc_fmu_step(rc_fmu *fmu, double time, double step, int *ended_early)
{
    const int watches = fmu->early_return && fmu->gap != NULL &&
                        rc_fmu_present_phase(fmu) == RC_FMU_STEPPING;
    *ended_early = 0;
    fmu->head->discarded = 0;
    if (fmu->head->sloped || watches)
        read_inputs(fmu, fmu->present);
    if (watches)
        rc_fmu_watch(fmu);
    rc_status status = rc_fmu_step_once(fmu, time, step);
    if (status == RC_OK && watches)
        status = rc_fmu_go_back_to_switch(fmu, time, step, ended_early);
    if (status != RC_OK) {
        fmu->head->discarded = status == RC_DISCARD;
        fmu->head->reached = rc_time(fmu->model);
        return rc_fmu_pass(fmu, status);
    }
    rc_fmu_warn(fmu);
    if (fmu->head->sloped)
        memset(fmu->slopes, 0, fmu->input_count * sizeof(double));
    fmu->head->sloped = 0;
    read_inputs(fmu, fmu->last);
    return RC_OK;
}

rc_status rc_fmu_adjoint(rc_fmu *fmu, const uint32_t *unknowns, size_t unknown_count,
                         const uint32_t *knowns, size_t known_count, const double *seed,
                         double *sensitivity)
{
    static const double ONE = 1.0;
    for (size_t k = 0; k < known_count; ++k) {
        sensitivity[k] = 0.0;
        for (size_t u = 0; u < unknown_count; ++u) {
            double derivative;
            const rc_status status =
                rc_derivative(fmu->model, &unknowns[u], 1, &knowns[k], 1, &ONE, &derivative);
            if (status != RC_OK)
                return status;
            sensitivity[k] += derivative * seed[u];
        }
    }
    return RC_OK;
}
