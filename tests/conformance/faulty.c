/* An FMU y' = u for FMI 2.0 co-simulation that fails on demand: with any status that a step can end
   with, or by crashing or hanging within any call. How often it still fails is not part of its
   state, so that going back does not bring a fault back. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define API __attribute__((visibility("default")))

enum { OK, WARNING, DISCARD, ERROR, FATAL };
enum { U, Y, FAULT, CALL, LEFT, START, REPORTED, LINEAR, WITNESS };
enum { NONE, DISCARDS, ERRS, DIES, IS_NAN, CRASHES, HANGS };

typedef struct { double u, u_before, y; } State;
typedef struct {
    State state;
    double start, reported;
    int fault, left, linear, dead;
    char call[64], witness[512];
} Fmu;

/* Every call passes here first; a call after death is written down. */
static int enter(Fmu *fmu, const char *call, double time)
{
    if (fmu->dead && fmu->witness[0]) {
        FILE *file = fopen(fmu->witness, "a");
        if (file) { fprintf(file, "%s\n", call); fclose(file); }
    }
    if (fmu->left == 0 || fmu->fault == NONE || strcmp(call, fmu->call) != 0 || time < fmu->start)
        return OK;
    fmu->left--;
    switch (fmu->fault) {
    case ERRS: return ERROR;
    case DIES: fmu->dead = 1; return FATAL;
    case IS_NAN: fmu->state.y = NAN; return OK;
    case CRASHES: abort();
    case HANGS: for (;;) sleep(1000);
    }
    return OK;
}

#define ENTER(call) { int status = enter(c, call, HUGE_VAL); if (status > WARNING) return status; }

API const char *fmi2GetVersion(void) { return "2.0"; }
API const char *fmi2GetTypesPlatform(void) { return "default"; }
API int fmi2SetDebugLogging(Fmu *c, int on, size_t n, const char *const names[])
{ (void)c; (void)on; (void)n; (void)names; return OK; }

API Fmu *fmi2Instantiate(const char *name, int kind, const char *guid, const char *resources,
                         const void *callbacks, int visible, int logging)
{
    (void)name; (void)kind; (void)guid; (void)resources; (void)callbacks; (void)visible; (void)logging;
    Fmu *fmu = calloc(1, sizeof(Fmu));
    fmu->state.y = 1.0;
    fmu->left = -1;
    strcpy(fmu->call, "doStep");
    return fmu;
}
API void fmi2FreeInstance(Fmu *c) { enter(c, "freeInstance", HUGE_VAL); free(c); }

API int fmi2SetupExperiment(Fmu *c, int t, double tolerance, double start, int s, double stop)
{ (void)t; (void)tolerance; (void)start; (void)s; (void)stop; ENTER("setupExperiment") return OK; }
API int fmi2EnterInitializationMode(Fmu *c) { ENTER("enterInitializationMode") return OK; }
API int fmi2ExitInitializationMode(Fmu *c)
{ ENTER("exitInitializationMode") c->state.u_before = c->state.u; return OK; }
API int fmi2Reset(Fmu *c) { ENTER("reset") return OK; }
API int fmi2Terminate(Fmu *c) { ENTER("terminate") return OK; }

API int fmi2SetReal(Fmu *c, const unsigned *r, size_t n, const double *values)
{
    ENTER("setReal")
    for (size_t i = 0; i < n; i++) {
        if (r[i] == U) c->state.u = values[i];
        else if (r[i] == START) c->start = values[i];
        else if (r[i] == REPORTED) c->reported = values[i];
        else return ERROR;
    }
    return OK;
}
API int fmi2GetReal(Fmu *c, const unsigned *r, size_t n, double *values)
{
    ENTER("getReal")
    for (size_t i = 0; i < n; i++)
        values[i] = r[i] == U ? c->state.u : r[i] == Y ? c->state.y : r[i] == START ? c->start : c->reported;
    return OK;
}
API int fmi2SetInteger(Fmu *c, const unsigned *r, size_t n, const int *values)
{
    for (size_t i = 0; i < n; i++) *(r[i] == FAULT ? &c->fault : &c->left) = values[i];
    return OK;
}
API int fmi2GetInteger(Fmu *c, const unsigned *r, size_t n, int *values)
{
    for (size_t i = 0; i < n; i++) values[i] = r[i] == FAULT ? c->fault : c->left;
    return OK;
}
API int fmi2SetBoolean(Fmu *c, const unsigned *r, size_t n, const int *values)
{ (void)r; for (size_t i = 0; i < n; i++) c->linear = values[i]; return OK; }
API int fmi2GetBoolean(Fmu *c, const unsigned *r, size_t n, int *values)
{ (void)r; for (size_t i = 0; i < n; i++) values[i] = c->linear; return OK; }
API int fmi2SetString(Fmu *c, const unsigned *r, size_t n, const char *const *values)
{
    for (size_t i = 0; i < n; i++)
        if (r[i] == CALL) snprintf(c->call, sizeof c->call, "%s", values[i]);
        else snprintf(c->witness, sizeof c->witness, "%s", values[i]);
    return OK;
}
API int fmi2GetString(Fmu *c, const unsigned *r, size_t n, const char **values)
{ for (size_t i = 0; i < n; i++) values[i] = r[i] == CALL ? c->call : c->witness; return OK; }

API int fmi2GetFMUstate(Fmu *c, State **state)
{
    ENTER("getFMUstate")
    if (!*state) { *state = malloc(sizeof(State)); }
    **state = c->state;
    return OK;
}
API int fmi2SetFMUstate(Fmu *c, State *state) { ENTER("setFMUstate") c->state = *state; return OK; }
API int fmi2FreeFMUstate(Fmu *c, State **state)
{
    ENTER("freeFMUstate")
    if (*state) { free(*state); *state = NULL; }
    return OK;
}
API int fmi2SerializedFMUstateSize(Fmu *c, State *state, size_t *size)
{ (void)state; ENTER("serialize") *size = sizeof(State); return OK; }
API int fmi2SerializeFMUstate(Fmu *c, State *state, char bytes[], size_t size)
{ ENTER("serialize") memcpy(bytes, state, size); return OK; }
API int fmi2DeSerializeFMUstate(Fmu *c, const char bytes[], size_t size, State **state)
{
    ENTER("deserialize")
    *state = malloc(size);
   
    memcpy(*state, bytes, size);
    return OK;
}

API int fmi2DoStep(Fmu *c, double time, double step, int keep)
{
    (void)keep;
    int status = OK;
    if (c->fault == DISCARDS)
        status = time + 1e-12 < c->start && c->start < time + step - 1e-12 ? DISCARD : OK;
    else
        status = enter(c, "doStep", time);
    if (status != OK) return status;
    double u_start = c->linear ? c->state.u_before : c->state.u;
    c->state.y += 0.5 * step * (u_start + c->state.u);
    c->state.u_before = c->state.u;
    return OK;
}
API int fmi2CancelStep(Fmu *c) { (void)c; return ERROR; }
API int fmi2GetRealStatus(Fmu *c, int kind, double *value)
{ ENTER("getRealStatus") *value = c->reported < 0.0 ? NAN : c->reported; return kind == 2 ? OK : DISCARD; }
API int fmi2GetStatus(Fmu *c, int kind, int *value) { (void)c; (void)kind; (void)value; return DISCARD; }
API int fmi2GetIntegerStatus(Fmu *c, int kind, int *value) { (void)c; (void)kind; (void)value; return DISCARD; }
API int fmi2GetBooleanStatus(Fmu *c, int kind, int *value) { (void)c; (void)kind; (void)value; return DISCARD; }
API int fmi2GetStringStatus(Fmu *c, int kind, const char **value) { (void)c; (void)kind; (void)value; return DISCARD; }
API int fmi2SetRealInputDerivatives(Fmu *c, const unsigned *r, size_t n, const int *o, const double *v)
{ (void)c; (void)r; (void)n; (void)o; (void)v; return ERROR; }
API int fmi2GetRealOutputDerivatives(Fmu *c, const unsigned *r, size_t n, const int *o, double *v)
{ (void)c; (void)r; (void)n; (void)o; (void)v; return ERROR; }
API int fmi2GetDirectionalDerivative(Fmu *c, const unsigned *z, size_t m, const unsigned *v, size_t n,
                                     const double *dv, double *dz)
{ (void)c; (void)z; (void)m; (void)v; (void)n; (void)dv; (void)dz; return ERROR; }
