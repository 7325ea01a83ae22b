/* FMI 3.0, as the fuzzer calls it. */
#include <stdlib.h>
#include <string.h>

#include "fmi3Functions.h"

#include "host.h"

static void log_message(fmi3InstanceEnvironment environment, fmi3Status status,
                        fmi3String category, fmi3String message)
{
    ear_hear(environment, (answer)status, category, message, 0);
}

static void *instantiate(const char *name, const char *token, const char *folder, ear *heard,
                         int logger, int logging, int early_return)
{
    return fmi3InstantiateCoSimulation(name, token, folder, false, logging, false, early_return,
                                       NULL, 0, heard, logger ? log_message : NULL, NULL);
}

static void release(void *fmu)
{
    fmi3FreeInstance(fmu);
}

static answer choose_log(void *fmu, int on, size_t count, const char *const *names)
{
    return (answer)fmi3SetDebugLogging(fmu, on, count, names);
}

static answer enter(void *fmu, double start, int has_stop, double stop)
{
    return (answer)fmi3EnterInitializationMode(fmu, false, 0.0, start, has_stop, stop);
}

static answer leave(void *fmu)
{
    return (answer)fmi3ExitInitializationMode(fmu);
}

static answer terminate(void *fmu)
{
    return (answer)fmi3Terminate(fmu);
}

static answer reset(void *fmu)
{
    return (answer)fmi3Reset(fmu);
}

static answer step(void *fmu, double time, double size, int without, double *reached, int *early)
{
    fmi3Boolean event = true, end = true, returned = false;
    const answer status = (answer)fmi3DoStep(
        fmu, time, size, true, without & 1 ? NULL : &event, without & 2 ? NULL : &end,
        without & 4 ? NULL : &returned, without & 8 ? NULL : reached);
    *early = returned;
    return status == OK && (event || end) ? FATAL : status;
}

static answer get(void *fmu, rc_type type, const list *of)
{
    const size_t n = of->count;
    answer status;
    if (type == RC_REAL) {
        fmi3Float64 *values = of->no_values ? NULL : exact(n, sizeof *values);
        status = (answer)fmi3GetFloat64(fmu, of->variables, n, values, of->said);
        for (size_t i = 0; values != NULL && i < n; ++i)
            of->values[i] = values[i];
        free(values);
    } else if (type == RC_TEXT) {
        fmi3String *values = of->no_values ? NULL : exact(n, sizeof *values);
        status = (answer)fmi3GetString(fmu, of->variables, n, values, of->said);
        for (size_t i = 0; values != NULL && i < n; ++i)
            of->texts[i] = values[i];
        free(values);
    } else if (type == RC_INTEGER) {
        fmi3Int32 *values = of->no_values ? NULL : exact(n, sizeof *values);
        status = (answer)fmi3GetInt32(fmu, of->variables, n, values, of->said);
        for (size_t i = 0; values != NULL && i < n; ++i)
            of->values[i] = values[i];
        free(values);
    } else {
        fmi3Boolean *values = of->no_values ? NULL : exact(n, sizeof *values);
        status = (answer)fmi3GetBoolean(fmu, of->variables, n, values, of->said);
        for (size_t i = 0; values != NULL && i < n; ++i)
            of->values[i] = values[i];
        free(values);
    }
    return status;
}

static answer set(void *fmu, rc_type type, const list *to)
{
    const size_t n = to->count;
    answer status;
    if (type == RC_REAL) {
        fmi3Float64 *values = to->no_values ? NULL : exact(n, sizeof *values);
        if (values != NULL)
            memcpy(values, to->values, n * sizeof *values);
        status = (answer)fmi3SetFloat64(fmu, to->variables, n, values, to->said);
        free(values);
    } else if (type == RC_TEXT) {
        fmi3String *values = to->no_values ? NULL : exact(n, sizeof *values);
        if (values != NULL)
            memcpy(values, to->texts, n * sizeof *values);
        status = (answer)fmi3SetString(fmu, to->variables, n, values, to->said);
        free(values);
    } else if (type == RC_INTEGER) {
        fmi3Int32 *values = to->no_values ? NULL : exact(n, sizeof *values);
        for (size_t i = 0; values != NULL && i < n; ++i)
            values[i] = (fmi3Int32)to->values[i];
        status = (answer)fmi3SetInt32(fmu, to->variables, n, values, to->said);
        free(values);
    } else {
        fmi3Boolean *values = to->no_values ? NULL : exact(n, sizeof *values);
        for (size_t i = 0; values != NULL && i < n; ++i)
            values[i] = to->values[i] != 0.0;
        status = (answer)fmi3SetBoolean(fmu, to->variables, n, values, to->said);
        free(values);
    }
    return status;
}

static answer get_slopes(void *fmu, const list *of, const int32_t *orders)
{
    return (answer)fmi3GetOutputDerivatives(fmu, of->variables, of->count, orders,
                                            of->no_values ? NULL : of->values, of->said);
}

static answer derive(void *fmu, const list *unknowns, const list *knowns)
{
    return (answer)fmi3GetDirectionalDerivative(
        fmu, unknowns->variables, unknowns->count, knowns->variables, knowns->count,
        knowns->no_values ? NULL : knowns->values, knowns->said,
        unknowns->no_values ? NULL : unknowns->values, unknowns->said);
}

static answer adjoin(void *fmu, const list *unknowns, const list *knowns)
{
    return (answer)fmi3GetAdjointDerivative(
        fmu, unknowns->variables, unknowns->count, knowns->variables, knowns->count,
        unknowns->no_values ? NULL : unknowns->values, unknowns->said,
        knowns->no_values ? NULL : knowns->values, knowns->said);
}

static answer save(void *fmu, void **state)
{
    return (answer)fmi3GetFMUState(fmu, state);
}

static answer restore(void *fmu, void *state)
{
    return (answer)fmi3SetFMUState(fmu, state);
}

static answer forget(void *fmu, void **state)
{
    return (answer)fmi3FreeFMUState(fmu, state);
}

static answer size_of_state(void *fmu, void *state, size_t *size)
{
    return (answer)fmi3SerializedFMUStateSize(fmu, state, size);
}

static answer serialise(void *fmu, void *state, void *bytes, size_t size)
{
    return (answer)fmi3SerializeFMUState(fmu, state, bytes, size);
}

static answer deserialise(void *fmu, const void *bytes, size_t size, void **state)
{
    return (answer)fmi3DeserializeFMUState(fmu, bytes, size, state);
}

/* Functions of other kinds of FMUs, of modes that these have not and of types without variables. */
static answer odd(void *fmu, draw *from, unsigned *right)
{
    const fmi3ValueReference variable = (fmi3ValueReference)draw_bits(from);
    fmi3Float64 real = 0.0;
    fmi3Boolean flags[4];
    fmi3Float32 single;
    fmi3UInt64 whole;
    fmi3Clock tick;
    size_t count;
    const size_t n = draw_below(from, 2);
    const int asked = (int)draw_below(from, 16);
    *right = 1u << ERROR;
    if (fmu != NULL && n == 0 && asked < 3)
        *right = 1u << OK;
    switch (asked) {
    case 0:
        return (answer)fmi3GetFloat32(fmu, &variable, n, &single, n);
    case 1:
        return (answer)fmi3GetUInt64(fmu, &variable, n, &whole, n);
    case 2:
        return (answer)fmi3SetUInt64(fmu, NULL, n, NULL, n);
    case 3:
        return (answer)fmi3GetBinary(fmu, &variable, 1, NULL, NULL, 1);
    case 4:
        return (answer)fmi3GetClock(fmu, &variable, 1, &tick);
    case 5:
        return (answer)fmi3EnterEventMode(fmu);
    case 6:
        return (answer)fmi3EnterStepMode(fmu);
    case 7:
        return (answer)fmi3EnterConfigurationMode(fmu);
    case 8:
        return (answer)fmi3ExitConfigurationMode(fmu);
    case 9:
        return (answer)fmi3UpdateDiscreteStates(fmu, flags, flags + 1, flags + 2, flags + 3, NULL,
                                                &real);
    case 10:
        return (answer)fmi3GetNumberOfVariableDependencies(fmu, variable, &count);
    case 11:
        return (answer)fmi3SetTime(fmu, draw_strange(from));
    case 12:
        return (answer)fmi3GetContinuousStates(fmu, NULL, 3);
    case 13:
        return (answer)fmi3GetEventIndicators(fmu, &real, 1);
    case 14:
        return (answer)fmi3CompletedIntegratorStep(fmu, true, NULL, NULL);
    default:
        return (answer)fmi3ActivateModelPartition(fmu, variable, real);
    }
}

const host host_fmi3 = {.version = 3,
                        .has_time = 1,
                        .instantiate = instantiate,
                        .release = release,
                        .choose_log = choose_log,
                        .enter = enter,
                        .leave = leave,
                        .terminate = terminate,
                        .reset = reset,
                        .step = step,
                        .get = get,
                        .set = set,
                        .get_slopes = get_slopes,
                        .derive = derive,
                        .adjoin = adjoin,
                        .save = save,
                        .restore = restore,
                        .forget = forget,
                        .size = size_of_state,
                        .serialise = serialise,
                        .deserialise = deserialise,
                        .odd = odd};
