/* FMI 2.0 for co-simulation: life, steps and their status. */
#include "fmi2.h"

#include <string.h>

static void tell(const rc_fmu *fmu, rc_status status, const char *category, const char *message)
{
    char escaped[2 * RC_MESSAGE_SIZE], *to = escaped;
    for (; *message != '\0'; ++message) { /* a format, in which # begins the name of a variable */
        if (*message == '%' || *message == '#')
            *to++ = *message;
        *to++ = *message;
    }
    *to = '\0';
    const fmi2CallbackLogger logger = (fmi2CallbackLogger)fmu->logger;
    const char *name = fmu->name == NULL ? "" : fmu->name; /* it may be what is missing */
    const fmi2Status said = status == RC_OK ? fmi2Warning : rc_fmi2_status(status);
    logger(fmu->environment, name, said, category, escaped);
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String folder,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean logging)
{
    (void)visible;
    if (functions == NULL)
        return NULL;
    if (type != fmi2CoSimulation) {
        if (functions->logger != NULL)
            functions->logger(functions->componentEnvironment, name == NULL ? "" : name, fmi2Error,
                              "logStatusError", "this FMU is for co-simulation only");
        return NULL;
    }
    return rc_fmu_create(&(rc_fmu_request){.name = name,
                                           .token = guid,
                                           .folder = folder,
                                           .log = tell,
                                           .logger = (void (*)(void))functions->logger,
                                           .environment = functions->componentEnvironment,
                                           .logging = logging != fmi2False});
}

void fmi2FreeInstance(fmi2Component c)
{
    rc_fmu_free(c);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count,
                               const fmi2String categories[])
{
    ENTER(c, RC_FMU_ANY);
    NEED(count, categories);
    return rc_fmi2_status(rc_fmu_choose_log(fmu, on != fmi2False, count, categories));
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean has_stop, fmi2Real stop)
{
    ENTER(c, RC_FMU_CREATED);
    (void)has_tolerance;
    (void)tolerance; /* the steps of the models are exact, or as fine as a parameter says */
    return rc_fmi2_status(rc_fmu_set_experiment(fmu, start, has_stop != fmi2False, stop));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    ENTER(c, RC_FMU_CREATED);
    return rc_fmi2_status(rc_fmu_enter(fmu));
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    ENTER(c, RC_FMU_INITIALISING);
    return rc_fmi2_status(rc_fmu_exit(fmu));
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    ENTER(c, RC_FMU_STEPPING);
    return rc_fmi2_status(rc_fmu_terminate(fmu));
}

fmi2Status fmi2Reset(fmi2Component c)
{
    ENTER(c, RC_FMU_ANY);
    rc_fmu_reset(fmu);
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real step, fmi2Boolean no_way_back)
{
    ENTER(c, RC_FMU_STEPPING);
    (void)no_way_back;
    int ended_early;
    return rc_fmi2_status(rc_fmu_step(fmu, time, step, &ended_early));
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    ENTER(c, RC_FMU_ANY);
    return rc_fmi2_status(rc_fmu_refuse(
        fmu, RC_ERROR, "there is no step to cancel: steps are over when fmi2DoStep returns"));
}

static fmi2Status refuse_status(rc_fmu *fmu, const char *call, fmi2StatusKind kind)
{
    return rc_fmi2_status(
        rc_fmu_refuse(fmu, RC_DISCARD, "%s does not know of status %d", call, (int)kind));
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    ENTER(c, RC_FMU_ANY);
    NEED(1, value);
    if (kind != fmi2DoStepStatus)
        return refuse_status(fmu, "fmi2GetStatus", kind);
    *value = fmu->head->discarded ? fmi2Discard : fmi2OK;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    ENTER(c, RC_FMU_ANY);
    NEED(1, value);
    if (kind != fmi2LastSuccessfulTime)
        return refuse_status(fmu, "fmi2GetRealStatus", kind);
    *value = fmu->head->reached;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    ENTER(c, RC_FMU_ANY);
    NEED(1, value);
    return refuse_status(fmu, "fmi2GetIntegerStatus", kind);
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    ENTER(c, RC_FMU_ANY);
    NEED(1, value);
    if (kind != fmi2Terminated)
        return refuse_status(fmu, "fmi2GetBooleanStatus", kind);
    *value = fmi2False; /* these models never ask for the end */
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    ENTER(c, RC_FMU_ANY);
    NEED(1, value);
    if (kind != fmi2PendingStatus)
        return refuse_status(fmu, "fmi2GetStringStatus", kind);
    *value = "";
    return fmi2OK;
}
