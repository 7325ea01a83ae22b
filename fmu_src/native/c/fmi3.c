/* FMI 3.0 for co-simulation: life and steps. */
#include "fmi3.h"

static void tell(const rc_fmu *fmu, rc_status status, const char *category, const char *message)
{
    const fmi3LogMessageCallback logger = (fmi3LogMessageCallback)fmu->logger;
    const fmi3Status said = status == RC_OK ? fmi3Warning : rc_fmi3_status(status);
    logger(fmu->environment, said, category, message);
}

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

static fmi3Instance refuse_type(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger)
{
    if (logger != NULL)
        logger(environment, fmi3Error, "logStatusError", "this FMU is for co-simulation only");
    return NULL;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String folder,
                                          fmi3Boolean visible, fmi3Boolean logging,
                                          fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback logger)
{
    (void)name, (void)token, (void)folder, (void)visible, (void)logging;
    return refuse_type(environment, logger);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String folder,
                                               fmi3Boolean visible, fmi3Boolean logging,
                                               fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback logger,
                                               fmi3ClockUpdateCallback clock_update,
                                               fmi3LockPreemptionCallback lock,
                                               fmi3UnlockPreemptionCallback unlock)
{
    (void)name, (void)token, (void)folder, (void)visible, (void)logging;
    (void)clock_update, (void)lock, (void)unlock;
    return refuse_type(environment, logger);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String folder,
                                         fmi3Boolean visible, fmi3Boolean logging,
                                         fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference intermediate[], size_t count,
                                         fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback logger,
                                         fmi3IntermediateUpdateCallback update)
{
    /* No event mode; every variable can be had in an update, named before or not. */
    (void)visible, (void)event_mode, (void)intermediate, (void)count;
    rc_fmu *fmu = rc_fmu_create(&(rc_fmu_request){.name = name,
                                                  .token = token,
                                                  .folder = folder,
                                                  .log = tell,
                                                  .logger = (void (*)(void))logger,
                                                  .environment = environment,
                                                  .logging = logging});
    if (fmu != NULL)
        fmu->early_return = early_return, fmu->update = (void (*)(void))update;
    return fmu;
}

void fmi3FreeInstance(fmi3Instance instance)
{
    rc_fmu_free(instance);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, size_t count,
                               const fmi3String categories[])
{
    ENTER(instance, RC_FMU_ANY);
    NEED(count, categories);
    return rc_fmi3_status(rc_fmu_choose_log(fmu, on, count, categories));
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean has_tolerance,
                                       fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop)
{
    ENTER(instance, RC_FMU_CREATED);
    (void)has_tolerance, (void)tolerance; /* the steps are exact, or as fine as a parameter says */
    if (rc_fmu_set_experiment(fmu, start, has_stop, stop) != RC_OK)
        return fmi3Error;
    return rc_fmi3_status(rc_fmu_enter(fmu));
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    ENTER(instance, RC_FMU_INITIALISING);
    return rc_fmi3_status(rc_fmu_exit(fmu));
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    ENTER(instance, RC_FMU_STEPPING);
    return rc_fmi3_status(rc_fmu_terminate(fmu));
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    ENTER(instance, RC_FMU_ANY);
    rc_fmu_reset(fmu);
    return fmi3OK;
}

/* Shows the host the values at the end of what was stepped, before fmi3DoStep returns. */
static void update_host(const rc_fmu *fmu)
{
    const fmi3IntermediateUpdateCallback update = (fmi3IntermediateUpdateCallback)fmu->update;
    fmi3Boolean leave = false; /* nothing is left to return from */
    fmi3Float64 until = fmu->head->reached;
    if (update != NULL)
        update(fmu->environment, fmu->head->reached, false, true, true, false, &leave, &until);
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 step,
                      fmi3Boolean no_way_back, fmi3Boolean *needs_event_mode,
                      fmi3Boolean *terminate, fmi3Boolean *returned_early, fmi3Float64 *reached)
{
    ENTER(instance, RC_FMU_STEPPING);
    NEED(1, needs_event_mode);
    NEED(1, terminate);
    NEED(1, returned_early);
    NEED(1, reached);
    (void)no_way_back;
    int ended_early;
    const rc_status status = rc_fmu_step(fmu, time, step, &ended_early);
    if (status == RC_OK)
        update_host(fmu);
    *needs_event_mode = *terminate = false;
    *returned_early = ended_early;
    *reached = fmu->head->reached;
    return rc_fmi3_status(status);
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference vr[], size_t n,
                                    const fmi3Int32 orders[], fmi3Float64 values[], size_t n_values)
{
    ENTER(instance, RC_FMU_STEPPING | RC_FMU_TERMINATED);
    NEED(n, vr);
    NEED(n, orders);
    NEED(n, values);
    MATCH(n, n_values);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i)
        status = rc_fmu_output_slope(fmu, vr[i], orders[i], &values[i]);
    return rc_fmi3_status(status);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        size_t unknown_count, const fmi3ValueReference knowns[],
                                        size_t known_count, const fmi3Float64 seed[],
                                        size_t seed_count, fmi3Float64 sensitivity[],
                                        size_t sensitivity_count)
{
    ENTER(instance, RC_FMU_INITIALISING | RC_FMU_STEPPING | RC_FMU_TERMINATED);
    NEED(unknown_count, unknowns);
    NEED(unknown_count, sensitivity);
    NEED(known_count, knowns);
    NEED(known_count, seed);
    MATCH(known_count, seed_count);
    MATCH(unknown_count, sensitivity_count);
    return rc_fmi3_status(rc_fmu_pass(
        fmu, rc_derivative(fmu->model, unknowns, unknown_count, knowns, known_count, seed,
                           sensitivity)));
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    size_t unknown_count, const fmi3ValueReference knowns[],
                                    size_t known_count, const fmi3Float64 seed[], size_t seed_count,
                                    fmi3Float64 sensitivity[], size_t sensitivity_count)
{
    ENTER(instance, RC_FMU_INITIALISING | RC_FMU_STEPPING | RC_FMU_TERMINATED);
    NEED(unknown_count, unknowns);
    NEED(unknown_count, seed);
    NEED(known_count, knowns);
    NEED(known_count, sensitivity);
    MATCH(unknown_count, seed_count);
    MATCH(known_count, sensitivity_count);
    return rc_fmi3_status(rc_fmu_pass(fmu, rc_fmu_adjoint(fmu, unknowns, unknown_count, knowns,
                                                          known_count, seed, sensitivity)));
}
