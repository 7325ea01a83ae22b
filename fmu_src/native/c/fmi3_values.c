/* FMI 3.0: values of variables, saved states. */
#include "fmi3.h"

#define MAY_GET RC_FMU_ANY
#define MAY_SET (RC_FMU_CREATED | RC_FMU_INITIALISING | RC_FMU_STEPPING)

#define CHECK(phases)                                                   \
    ENTER(instance, phases);                                            \
    NEED(n, vr);                                                        \
    NEED(n, values);                                                    \
    MATCH(n, n_values)

/* Values of which some are that of time, which follows the variables of the model. */
static rc_status get_with_time(rc_fmu *fmu, const fmi3ValueReference vr[], size_t n,
                               fmi3Float64 values[])
{
    const uint32_t time = rc_variable_count(fmu->model);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i) {
        if (vr[i] == time)
            values[i] = rc_fmu_present_phase(fmu) == RC_FMU_CREATED ? fmu->head->start_time
                                                                    : rc_time(fmu->model);
        else
            status = rc_get(fmu->model, RC_REAL, &vr[i], 1, &values[i]);
    }
    return status;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                          fmi3Float64 values[], size_t n_values)
{
    CHECK(MAY_GET);
    for (size_t i = 0; i < n; ++i)
        if (vr[i] == rc_variable_count(fmu->model))
            return rc_fmi3_status(rc_fmu_pass(fmu, get_with_time(fmu, vr, n, values)));
    return rc_fmi3_status(rc_fmu_pass(fmu, rc_get(fmu->model, RC_REAL, vr, n, values)));
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
