/* FMI 2.0 for co-simulation over a model. */

#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"
#include "model.h"

typedef struct {
    Model *model;
    Surroundings around;
    Result last;
    fmi2CallbackFunctions callbacks;
    char name[64];
} Instance;

/* Keeps the compiler from leaving out what nobody uses. */
static void *volatile hoard;

#define THE(c) Instance *self = c; Model *model = self->model; (void)model

static fmi2Status say(Instance *self, Outcome outcome, const char *message) {
    if (message)
        self->callbacks.logger(self->callbacks.componentEnvironment, self->name,
                               (fmi2Status)outcome, "model", message);
    return (fmi2Status)outcome;
}

static void *at(Model *model, fmi2ValueReference vr, Kind kind) {
    if (vr >= variable_count || variables[vr].kind != kind) return NULL;
    return (char *)model + variables[vr].offset;
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[]) {
    (void)c, (void)on, (void)n, (void)names;
    return fmi2OK;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible,
                              fmi2Boolean logging) {
    (void)guid, (void)resources, (void)visible, (void)logging;
    if (type != fmi2CoSimulation) return NULL;
    Instance *self = calloc(1, sizeof *self);
    self->model = calloc(1, model_size);
    self->callbacks = *callbacks;
    strncpy(self->name, name, sizeof self->name - 1);
    model_reset(self->model);
    return self;
}

void fmi2FreeInstance(fmi2Component c) {
    THE(c);
    free(model);
    free(self);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean has_stop, fmi2Real stop) {
    (void)c, (void)has_tolerance, (void)tolerance, (void)start, (void)has_stop, (void)stop;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) { (void)c; return fmi2OK; }

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    THE(c);
    Outcome outcome = model_start(model);
    return say(self, outcome, outcome == OK ? NULL : "no initial state, 100 % sure");
}

fmi2Status fmi2Terminate(fmi2Component c) { (void)c; return fmi2OK; }

fmi2Status fmi2Reset(fmi2Component c) {
    THE(c);
    model_reset(model);
    return fmi2OK;
}

#define ACCESS(Type, KIND, stored)                                                                \
    fmi2Status fmi2Get##Type(fmi2Component c, const fmi2ValueReference vr[], size_t n,            \
                             fmi2##Type value[]) {                                                \
        THE(c);                                                                                   \
        model_evaluate(model);                                                                    \
        for (size_t i = 0; i < n; i++) {                                                          \
            stored *place = at(model, vr[i], KIND);                                               \
            if (!place) return say(self, ERROR, "no such variable to get");                       \
            value[i] = *place;                                                                    \
        }                                                                                         \
        return fmi2OK;                                                                            \
    }                                                                                             \
    fmi2Status fmi2Set##Type(fmi2Component c, const fmi2ValueReference vr[], size_t n,            \
                             const fmi2##Type value[]) {                                          \
        THE(c);                                                                                   \
        for (size_t i = 0; i < n; i++) {                                                          \
            stored *place = at(model, vr[i], KIND);                                               \
            if (!place) return say(self, ERROR, "no such variable to set");                       \
            *place = (stored)value[i];                                                            \
        }                                                                                         \
        return fmi2OK;                                                                            \
    }

ACCESS(Real, FLOAT64, double)
ACCESS(Integer, INT32, int32_t)
ACCESS(Boolean, BOOLEAN, bool)

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2String v[]) {
    (void)vr, (void)v;
    return n ? say(c, ERROR, "there are no strings") : fmi2OK;
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         const fmi2String v[]) {
    (void)vr, (void)v;
    return n ? say(c, ERROR, "there are no strings") : fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    THE(c);
    if (!*state) *state = malloc(model_size);
    memcpy(*state, model, model_size);
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    THE(c);
    Model *before = malloc(model_size);
    memcpy(before, model, model_size);
    memcpy(model, state, model_size);
    model_restored(model, before);
    free(before);
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    THE(c);
    if (model_leaks(model)) hoard = memset(malloc(10000), 1, 10000);
    free(*state);
    *state = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
    (void)c, (void)state;
    *size = model_size;
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte data[], size_t size) {
    (void)c;
    memcpy(data, state, size);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte data[], size_t size,
                                   fmi2FMUstate *state) {
    if (size != model_size) return say(c, ERROR, "these bytes are no state");
    *state = malloc(model_size);
    memcpy(*state, data, size);
    return fmi2OK;
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[],
                                        size_t rows, const fmi2ValueReference known[],
                                        size_t columns, const fmi2Real seed[], fmi2Real result[]) {
    THE(c);
    for (size_t j = 0; j < rows; j++) {
        result[j] = 0.0;
        for (size_t i = 0; i < columns; i++)
            result[j] += model_derivative(model, unknown[j], 0, known[i], 0) * seed[i];
    }
    return fmi2OK;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    THE(c);
    for (size_t i = 0; i < n; i++)
        if (order[i] != 1 || !model_set_slope(model, vr[i], value[i]))
            return say(self, ERROR, "no such derivative");
    return fmi2OK;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                        const fmi2Integer order[], fmi2Real value[]) {
    (void)vr, (void)n, (void)order, (void)value;
    return say(c, ERROR, "there are no output derivatives");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step_size, fmi2Boolean no_return) {
    THE(c);
    (void)no_return;
    self->last = model_step(model, &self->around, time, step_size);
    return say(self, self->last.outcome, self->last.message);
}

fmi2Status fmi2CancelStep(fmi2Component c) { return say(c, ERROR, "there is nothing to cancel"); }

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
    (void)c, (void)kind, (void)value;
    return fmi2Discard;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
    THE(c);
    *value = self->last.reached;
    return kind == fmi2LastSuccessfulTime ? fmi2OK : fmi2Discard;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
    (void)c, (void)kind, (void)value;
    return fmi2Discard;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
    THE(c);
    *value = self->last.terminate;
    return kind == fmi2Terminated ? fmi2OK : fmi2Discard;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
    (void)c, (void)kind, (void)value;
    return fmi2Discard;
}
