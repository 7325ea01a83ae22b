/* FMI 3.0 for co-simulation over a model. */

#include <stdlib.h>
#include <string.h>

#include "fmi3Functions.h"
#include "model.h"

typedef struct {
    Model *model;
    Surroundings around;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
} Instance;

/* Keeps the compiler from leaving out what nobody uses. */
static void *volatile hoard;

#define THE(c) Instance *self = c; Model *model = self->model; (void)model

static fmi3Status say(Instance *self, Outcome outcome, const char *message) {
    if (message) self->log(self->environment, (fmi3Status)outcome, "model", message);
    return (fmi3Status)outcome;
}

static void *at(Model *model, fmi3ValueReference vr, Kind kind) {
    if (vr >= variable_count || variables[vr].kind != kind) return NULL;
    return (char *)model + variables[vr].offset;
}

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t n, const fmi3String names[]) {
    (void)c, (void)on, (void)n, (void)names;
    return fmi3OK;
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
    fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean may_return_early,
    const fmi3ValueReference required[], size_t n, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update) {
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)required;
    (void)update;
    if (event_mode || n) return NULL;
    Instance *self = calloc(1, sizeof *self);
    self->model = calloc(1, model_size);
    self->around.may_return_early = may_return_early;
    self->environment = environment;
    self->log = log;
    model_reset(self->model);
    return self;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                          fmi3Boolean visible, fmi3Boolean logging,
                                          fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)environment;
    (void)log;
    return NULL;
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
    fmi3Boolean logging, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
    fmi3UnlockPreemptionCallback unlock) {
    (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)environment;
    (void)log, (void)update, (void)lock, (void)unlock;
    return NULL;
}

void fmi3FreeInstance(fmi3Instance c) {
    THE(c);
    free(model);
    free(self);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean has_tolerance,
                                       fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop) {
    (void)c, (void)has_tolerance, (void)tolerance, (void)start, (void)has_stop, (void)stop;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance c) {
    THE(c);
    Outcome outcome = model_start(model);
    return say(self, outcome, outcome == OK ? NULL : "no initial state, 100 % sure");
}

fmi3Status fmi3Terminate(fmi3Instance c) { (void)c; return fmi3OK; }

fmi3Status fmi3Reset(fmi3Instance c) {
    THE(c);
    model_reset(model);
    return fmi3OK;
}

/* Copies between `values` and variables of one kind, in the order of the references. */
static fmi3Status copy(Instance *self, Kind kind, size_t width, const fmi3ValueReference vr[],
                       size_t n, char *values, size_t count, bool set) {
    for (size_t i = 0; i < n; i++) {
        void *place = at(self->model, vr[i], kind);
        size_t size = place ? variables[vr[i]].size : 0;
        if (!place || size > count) return say(self, ERROR, "no such variable, or of another size");
        if (set) memcpy(place, values, size * width);
        else memcpy(values, place, size * width);
        values += size * width;
        count -= size;
    }
    return count ? say(self, ERROR, "too many values") : fmi3OK;
}

#define ACCESS(Type, KIND)                                                                        \
    fmi3Status fmi3Get##Type(fmi3Instance c, const fmi3ValueReference vr[], size_t n,             \
                             fmi3##Type values[], size_t count) {                                 \
        THE(c);                                                                                   \
        model_evaluate(model);                                                                    \
        return copy(self, KIND, sizeof *values, vr, n, (char *)values, count, false);             \
    }                                                                                             \
    fmi3Status fmi3Set##Type(fmi3Instance c, const fmi3ValueReference vr[], size_t n,             \
                             const fmi3##Type values[], size_t count) {                           \
        return copy(c, KIND, sizeof *values, vr, n, (char *)values, count, true);                 \
    }

ACCESS(Float64, FLOAT64)
ACCESS(Float32, FLOAT32)
ACCESS(Int8, INT8)
ACCESS(UInt8, UINT8)
ACCESS(Int16, INT16)
ACCESS(UInt16, UINT16)
ACCESS(Int32, INT32)
ACCESS(UInt32, UINT32)
ACCESS(Int64, INT64)
ACCESS(UInt64, UINT64)
ACCESS(Boolean, BOOLEAN)

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state) {
    THE(c);
    if (!*state) *state = malloc(model_size);
    memcpy(*state, model, model_size);
    return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
    THE(c);
    Model *before = malloc(model_size);
    memcpy(before, model, model_size);
    memcpy(model, state, model_size);
    model_restored(model, before);
    free(before);
    return fmi3OK;
}

fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state) {
    THE(c);
    if (model_leaks(model)) hoard = memset(malloc(10000), 1, 10000);
    free(*state);
    *state = NULL;
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size) {
    (void)c, (void)state;
    *size = model_size;
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte data[], size_t size) {
    (void)c;
    memcpy(data, state, size);
    return fmi3OK;
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte data[], size_t size,
                                   fmi3FMUState *state) {
    if (size != model_size) return say(c, ERROR, "these bytes are no state");
    *state = malloc(model_size);
    memcpy(*state, data, size);
    return fmi3OK;
}

static bool sizes_fit(const fmi3ValueReference vr[], size_t n, size_t count) {
    size_t sum = 0;
    for (size_t i = 0; i < n; i++) sum += variables[vr[i]].size;
    return sum == count;
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, const fmi3ValueReference unknown[],
                                        size_t rows, const fmi3ValueReference known[],
                                        size_t columns, const fmi3Float64 seed[], size_t n_seed,
                                        fmi3Float64 result[], size_t n_result) {
    THE(c);
    if (!sizes_fit(unknown, rows, n_result) || !sizes_fit(known, columns, n_seed))
        return say(self, ERROR, "the seed is of another size");
    for (size_t row = 0; row < rows; row++)
        for (size_t j = 0; j < variables[unknown[row]].size; j++, result++) {
            const fmi3Float64 *factor = seed;
            *result = 0.0;
            for (size_t column = 0; column < columns; column++)
                for (size_t i = 0; i < variables[known[column]].size; i++)
                    *result += model_derivative(model, unknown[row], j, known[column], i) * *factor++;
        }
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 step_size,
                      fmi3Boolean no_return, fmi3Boolean *event, fmi3Boolean *terminate,
                      fmi3Boolean *early, fmi3Float64 *reached) {
    THE(c);
    (void)no_return;
    Result result = model_step(model, &self->around, time, step_size);
    *event = false;
    *terminate = result.terminate;
    *early = result.early;
    *reached = result.reached;
    return say(self, result.terminate ? OK : result.outcome, result.message);
}
