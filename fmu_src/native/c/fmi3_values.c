/* FMI 3.0: values of variables, saved states. */
#include <string.h>

#include "fmi3.h"

#define MAY_GET RC_FMU_ANY
#define MAY_SET (RC_FMU_CREATED | RC_FMU_INITIALISING | RC_FMU_STEPPING)

#define CHECK(phases)                                                   \
    ENTER(instance, phases);                                            \
    NEED(n, vr);                                                        \
    NEED(n, values);                                                    \
    MATCH(n, n_values)

/* The variables of the model are followed by time, and this by arrays: what is `offset` behind time
 * shows all Real inputs or outputs whose names differ from that of variable `offset - 1` by an
 * index only, which is their first. NULL: there is no such array. */
static const rc_group *array_at(const rc_fmu *fmu, fmi3ValueReference reference)
{
    const uint32_t time = rc_variable_count(fmu->model);
    if (reference <= time)
        return NULL;
    const rc_group *group = rc_group_of(fmu->model, reference - time - 1);
    const int shown = group != NULL && group->type == RC_REAL && strchr(group->name, '#') != NULL &&
                      (group->causality == RC_INPUT || group->causality == RC_OUTPUT) &&
                      group->first == reference - time - 1;
    return shown ? group : NULL;
}

static rc_status get_one(rc_fmu *fmu, fmi3ValueReference reference, fmi3Float64 *value)
{
    if (reference != rc_variable_count(fmu->model))
        return rc_get(fmu->model, RC_REAL, &reference, 1, value);
    *value = rc_fmu_present_phase(fmu) == RC_FMU_CREATED ? fmu->head->start_time
                                                         : rc_time(fmu->model);
    return RC_OK;
}

/* Values of which some are that of time or arrays. */
static rc_status get_with_arrays(rc_fmu *fmu, const fmi3ValueReference vr[], size_t n,
                                 fmi3Float64 values[])
{
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i) {
        const rc_group *array = array_at(fmu, vr[i]);
        if (array == NULL)
            status = get_one(fmu, vr[i], values++);
        for (uint32_t k = 0; array != NULL && k < array->count && status == RC_OK; ++k)
            status = get_one(fmu, array->first + k, values++);
    }
    return status;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                          fmi3Float64 values[], size_t n_values)
{
    ENTER(instance, MAY_GET);
    NEED(n, vr);
    NEED(n, values);
    size_t size = 0;
    int plain = 1;
    for (size_t i = 0; i < n; ++i) {
        const rc_group *array = array_at(fmu, vr[i]);
        size += array == NULL ? 1 : array->count;
        plain = plain && vr[i] < rc_variable_count(fmu->model);
    }
    MATCH(size, n_values);
    return rc_fmi3_status(rc_fmu_pass(fmu, plain ? rc_get(fmu->model, RC_REAL, vr, n, values)
                                                 : get_with_arrays(fmu, vr, n, values)));
}

fmi3Status fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                        fmi3Int32 values[], size_t n_values)
{
    CHECK(MAY_GET);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i) {
        double number = 0.0;
        status = rc_get(fmu->model, RC_INTEGER, &vr[i], 1, &number);
        if (status == RC_OK)
            values[i] = (fmi3Int32)number;
    }
    return rc_fmi3_status(rc_fmu_pass(fmu, status));
}

fmi3Status fmi3GetBoolean(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                          fmi3Boolean values[], size_t n_values)
{
    CHECK(MAY_GET);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i) {
        double number = 0.0;
        status = rc_get(fmu->model, RC_BOOLEAN, &vr[i], 1, &number);
        if (status == RC_OK)
            values[i] = number != 0.0;
    }
    return rc_fmi3_status(rc_fmu_pass(fmu, status));
}

fmi3Status fmi3GetString(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                         fmi3String values[], size_t n_values)
{
    CHECK(MAY_GET);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i)
        status = rc_get_text(fmu->model, vr[i], &values[i]);
    return rc_fmi3_status(rc_fmu_pass(fmu, status));
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                          const fmi3Float64 values[], size_t n_values)
{
    CHECK(MAY_SET);
    return rc_fmi3_status(rc_fmu_pass(fmu, rc_set(fmu->model, RC_REAL, vr, n, values)));
}

fmi3Status fmi3SetInt32(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                        const fmi3Int32 values[], size_t n_values)
{
    CHECK(MAY_SET);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i) {
        const double number = values[i];
        status = rc_set(fmu->model, RC_INTEGER, &vr[i], 1, &number);
    }
    return rc_fmi3_status(rc_fmu_pass(fmu, status));
}

fmi3Status fmi3SetBoolean(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                          const fmi3Boolean values[], size_t n_values)
{
    CHECK(MAY_SET);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i) {
        const double number = values[i];
        status = rc_set(fmu->model, RC_BOOLEAN, &vr[i], 1, &number);
    }
    return rc_fmi3_status(rc_fmu_pass(fmu, status));
}

fmi3Status fmi3SetString(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                         const fmi3String values[], size_t n_values)
{
    CHECK(MAY_SET);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i) {
        NEED(1, values[i]);
        status = rc_set_text(fmu->model, vr[i], values[i]);
    }
    return rc_fmi3_status(rc_fmu_pass(fmu, status));
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state)
{
    ENTER(instance, RC_FMU_ANY);
    NEED(1, state);
    return rc_fmi3_status(rc_fmu_save(fmu, state));
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state)
{
    ENTER(instance, RC_FMU_ANY);
    return rc_fmi3_status(rc_fmu_restore(fmu, state));
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state)
{
    ENTER(instance, RC_FMU_ANY);
    NEED(1, state);
    return rc_fmi3_status(rc_fmu_forget(fmu, state));
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t *size)
{
    ENTER(instance, RC_FMU_ANY);
    NEED(1, size);
    return rc_fmi3_status(rc_fmu_serialised_size(fmu, state, size));
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[],
                                 size_t size)
{
    ENTER(instance, RC_FMU_ANY);
    NEED(1, bytes);
    return rc_fmi3_status(rc_fmu_serialise(fmu, state, bytes, size));
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState *state)
{
    ENTER(instance, RC_FMU_ANY);
    NEED(1, bytes);
    NEED(1, state);
    return rc_fmi3_status(rc_fmu_deserialise(fmu, bytes, size, state));
}
