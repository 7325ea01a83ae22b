/* FMI 2.0, as the fuzzer calls it. */
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"

#include "host.h"

static void log_message(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                        fmi2String category, fmi2String message, ...)
{
    if (name == NULL)
        ((ear *)environment)->bad = 1;
    ear_hear(environment, (answer)status, category, message, 1);
}

static void *instantiate(const char *name, const char *token, const char *folder, ear *heard,
                         int logger, int logging, int early_return)
{
    const fmi2CallbackFunctions functions = {.logger = logger ? log_message : NULL,
                                             .allocateMemory = calloc,
                                             .freeMemory = free,
                                             .componentEnvironment = heard};
    /* the functions stay where they are, as the standard demands, though nothing needs them */
    fmi2CallbackFunctions *kept = exact(1, sizeof *kept);
    memcpy(kept, &functions, sizeof functions);
    fmi2Component made = fmi2Instantiate(name, fmi2CoSimulation, token, folder, kept,
                                         early_return, logging);
    free(kept);
    return made;
}

static void release(void *fmu)
{
    fmi2FreeInstance(fmu);
}

static answer choose_log(void *fmu, int on, size_t count, const char *const *names)
{
    return (answer)fmi2SetDebugLogging(fmu, on, count, names);
}

static answer set_up(void *fmu, double start, int has_stop, double stop)
{
    return (answer)fmi2SetupExperiment(fmu, fmi2False, 0.0, start, has_stop, stop);
}

static answer enter(void *fmu, double start, int has_stop, double stop)
{
    (void)start, (void)has_stop, (void)stop;
    return (answer)fmi2EnterInitializationMode(fmu);
}

static answer leave(void *fmu)
{
    return (answer)fmi2ExitInitializationMode(fmu);
}

static answer terminate(void *fmu)
{
    return (answer)fmi2Terminate(fmu);
}

static answer reset(void *fmu)
{
    return (answer)fmi2Reset(fmu);
}

static answer step(void *fmu, double time, double size, int without, double *reached, int *early)
{
    const answer status = (answer)fmi2DoStep(fmu, time, size, without & 1);
    *early = 0;
    if (fmu != NULL && fmi2GetRealStatus(fmu, fmi2LastSuccessfulTime, reached) != fmi2OK)
        return FATAL;
    fmi2Status last;
    if (fmu != NULL && status != ERROR &&
        (fmi2GetStatus(fmu, fmi2DoStepStatus, &last) != fmi2OK || (answer)last != status))
        return FATAL;
    return status;
}

static answer get(void *fmu, rc_type type, const list *of)
{
    const size_t n = of->count;
    answer status;
    if (type == RC_REAL) {
        fmi2Real *values = of->no_values ? NULL : exact(n, sizeof *values);
        status = (answer)fmi2GetReal(fmu, of->variables, n, values);
        for (size_t i = 0; values != NULL && i < n; ++i)
            of->values[i] = values[i];
        free(values);
    } else if (type == RC_TEXT) {
        fmi2String *values = of->no_values ? NULL : exact(n, sizeof *values);
        status = (answer)fmi2GetString(fmu, of->variables, n, values);
        for (size_t i = 0; values != NULL && i < n; ++i)
            of->texts[i] = values[i];
        free(values);
    } else {
        fmi2Integer *values = of->no_values ? NULL : exact(n, sizeof *values);
        status = (answer)(type == RC_INTEGER ? fmi2GetInteger(fmu, of->variables, n, values)
                                             : fmi2GetBoolean(fmu, of->variables, n, values));
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
        fmi2Real *values = to->no_values ? NULL : exact(n, sizeof *values);
        if (values != NULL)
            memcpy(values, to->values, n * sizeof *values);
        status = (answer)fmi2SetReal(fmu, to->variables, n, values);
        free(values);
    } else if (type == RC_TEXT) {
        fmi2String *values = to->no_values ? NULL : exact(n, sizeof *values);
        if (values != NULL)
            memcpy(values, to->texts, n * sizeof *values);
        status = (answer)fmi2SetString(fmu, to->variables, n, values);
        free(values);
    } else {
        fmi2Integer *values = to->no_values ? NULL : exact(n, sizeof *values);
        for (size_t i = 0; values != NULL && i < n; ++i)
            values[i] = (fmi2Integer)to->values[i];
        status = (answer)(type == RC_INTEGER ? fmi2SetInteger(fmu, to->variables, n, values)
                                             : fmi2SetBoolean(fmu, to->variables, n, values));
        free(values);
    }
    return status;
}

static answer set_slopes(void *fmu, const list *to, const int32_t *orders)
{
    return (answer)fmi2SetRealInputDerivatives(fmu, to->variables, to->count, orders,
                                               to->no_values ? NULL : to->values);
}

static answer get_slopes(void *fmu, const list *of, const int32_t *orders)
{
    return (answer)fmi2GetRealOutputDerivatives(fmu, of->variables, of->count, orders,
                                                of->no_values ? NULL : of->values);
}

static answer derive(void *fmu, const list *unknowns, const list *knowns)
{
    return (answer)fmi2GetDirectionalDerivative(
        fmu, unknowns->variables, unknowns->count, knowns->variables, knowns->count,
        knowns->no_values ? NULL : knowns->values, unknowns->no_values ? NULL : unknowns->values);
}

static answer save(void *fmu, void **state)
{
    return (answer)fmi2GetFMUstate(fmu, state);
}

static answer restore(void *fmu, void *state)
{
    return (answer)fmi2SetFMUstate(fmu, state);
}

static answer forget(void *fmu, void **state)
{
    return (answer)fmi2FreeFMUstate(fmu, state);
}

static answer size_of_state(void *fmu, void *state, size_t *size)
{
    return (answer)fmi2SerializedFMUstateSize(fmu, state, size);
}

static answer serialise(void *fmu, void *state, void *bytes, size_t size)
{
    return (answer)fmi2SerializeFMUstate(fmu, state, bytes, size);
}

static answer deserialise(void *fmu, const void *bytes, size_t size, void **state)
{
    return (answer)fmi2DeSerializeFMUstate(fmu, bytes, size, state);
}

/* Of any status, with and without a place for it; and the calls that never change anything. */
static answer odd(void *fmu, draw *from, unsigned *right)
{
    static const int kinds[] = {fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime,
                                fmi2Terminated, 4, 77};
    const fmi2StatusKind kind =
        (fmi2StatusKind)kinds[draw_below(from, sizeof kinds / sizeof kinds[0])];
    const int there = !draw_once_in(from, 4);
    fmi2Status status;
    fmi2Real real;
    fmi2Integer whole;
    fmi2String text;
    const int asked = (int)draw_below(from, 6);
    const int known[] = {fmi2DoStepStatus, fmi2LastSuccessfulTime, -1, fmi2Terminated,
                         fmi2PendingStatus};
    *right = asked == 5 || fmu == NULL || !there ? 1u << ERROR
             : (int)kind == known[asked]         ? 1u << OK
                                                 : 1u << DISCARD;
    switch (asked) {
    case 0:
        return (answer)fmi2GetStatus(fmu, kind, there ? &status : NULL);
    case 1:
        return (answer)fmi2GetRealStatus(fmu, kind, there ? &real : NULL);
    case 2:
        return (answer)fmi2GetIntegerStatus(fmu, kind, there ? &whole : NULL);
    case 3:
        return (answer)fmi2GetBooleanStatus(fmu, kind, there ? &whole : NULL);
    case 4:
        return (answer)fmi2GetStringStatus(fmu, kind, there ? &text : NULL);
    default:
        return (answer)fmi2CancelStep(fmu);
    }
}

const host host_fmi2 = {.version = 2,
                        .instantiate = instantiate,
                        .release = release,
                        .choose_log = choose_log,
                        .set_up = set_up,
                        .enter = enter,
                        .leave = leave,
                        .terminate = terminate,
                        .reset = reset,
                        .step = step,
                        .get = get,
                        .set = set,
                        .set_slopes = set_slopes,
                        .get_slopes = get_slopes,
                        .derive = derive,
                        .save = save,
                        .restore = restore,
                        .forget = forget,
                        .size = size_of_state,
                        .serialise = serialise,
                        .deserialise = deserialise,
                        .odd = odd};
