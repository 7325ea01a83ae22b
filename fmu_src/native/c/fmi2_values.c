/* FMI 2.0: values of variables, their derivatives, saved states. */
#include "fmi2.h"

#define MAY_GET RC_FMU_ANY
#define MAY_SET (RC_FMU_CREATED | RC_FMU_INITIALISING | RC_FMU_STEPPING)
#define MAY_DERIVE (RC_FMU_INITIALISING | RC_FMU_STEPPING | RC_FMU_TERMINATED)

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[])
{
    ENTER(c, MAY_GET);
    NEED(n, vr);
    NEED(n, value);
    return rc_fmi2_status(rc_fmu_pass(fmu, rc_get(fmu->model, RC_REAL, vr, n, value)));
}

static fmi2Status get_whole(rc_fmu *fmu, rc_type type, const fmi2ValueReference vr[], size_t n,
                            int value[])
{
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i) {
        double number = 0.0;
        status = rc_get(fmu->model, type, &vr[i], 1, &number);
        if (status == RC_OK)
            value[i] = (int)number;
    }
    return rc_fmi2_status(rc_fmu_pass(fmu, status));
}

static fmi2Status set_whole(rc_fmu *fmu, rc_type type, const fmi2ValueReference vr[], size_t n,
                            const int value[])
{
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i) {
        const double number = type == RC_BOOLEAN ? value[i] != 0 : value[i];
        status = rc_set(fmu->model, type, &vr[i], 1, &number);
    }
    return rc_fmi2_status(rc_fmu_pass(fmu, status));
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          fmi2Integer value[])
{
    ENTER(c, MAY_GET);
    NEED(n, vr);
    NEED(n, value);
    return get_whole(fmu, RC_INTEGER, vr, n, value);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          fmi2Boolean value[])
{
    ENTER(c, MAY_GET);
    NEED(n, vr);
    NEED(n, value);
    return get_whole(fmu, RC_BOOLEAN, vr, n, value);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         fmi2String value[])
{
    ENTER(c, MAY_GET);
    NEED(n, vr);
    NEED(n, value);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i)
        status = rc_get_text(fmu->model, vr[i], &value[i]);
    return rc_fmi2_status(rc_fmu_pass(fmu, status));
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                       const fmi2Real value[])
{
    ENTER(c, MAY_SET);
    NEED(n, vr);
    NEED(n, value);
    return rc_fmi2_status(rc_fmu_pass(fmu, rc_set(fmu->model, RC_REAL, vr, n, value)));
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          const fmi2Integer value[])
{
    ENTER(c, MAY_SET);
    NEED(n, vr);
    NEED(n, value);
    return set_whole(fmu, RC_INTEGER, vr, n, value);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                          const fmi2Boolean value[])
{
    ENTER(c, MAY_SET);
    NEED(n, vr);
    NEED(n, value);
    return set_whole(fmu, RC_BOOLEAN, vr, n, value);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                         const fmi2String value[])
{
    ENTER(c, MAY_SET);
    NEED(n, vr);
    NEED(n, value);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i) {
        NEED(1, value[i]);
        status = rc_set_text(fmu->model, vr[i], value[i]);
    }
    return rc_fmi2_status(rc_fmu_pass(fmu, status));
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    ENTER(c, MAY_SET);
    NEED(n, vr);
    NEED(n, order);
    NEED(n, value);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i)
        status = rc_fmu_set_slope(fmu, vr[i], order[i], value[i]);
    return rc_fmi2_status(status);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                        const fmi2Integer order[], fmi2Real value[])
{
    ENTER(c, MAY_DERIVE);
    NEED(n, vr);
    NEED(n, order);
    NEED(n, value);
    rc_status status = RC_OK;
    for (size_t i = 0; i < n && status == RC_OK; ++i)
        status = rc_fmu_output_slope(fmu, vr[i], order[i], &value[i]);
    return rc_fmi2_status(status);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[],
                                        size_t unknown_count, const fmi2ValueReference knowns[],
                                        size_t known_count, const fmi2Real seed[],
                                        fmi2Real sensitivity[])
{
    ENTER(c, MAY_DERIVE);
    NEED(unknown_count, unknowns);
    NEED(unknown_count, sensitivity);
    NEED(known_count, knowns);
    NEED(known_count, seed);
    return rc_fmi2_status(rc_fmu_pass(
        fmu, rc_derivative(fmu->model, unknowns, unknown_count, knowns, known_count, seed,
                           sensitivity)));
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    ENTER(c, RC_FMU_ANY);
    NEED(1, state);
    return rc_fmi2_status(rc_fmu_save(fmu, state));
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    ENTER(c, RC_FMU_ANY);
    return rc_fmi2_status(rc_fmu_restore(fmu, state));
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    ENTER(c, RC_FMU_ANY);
    NEED(1, state);
    return rc_fmi2_status(rc_fmu_forget(fmu, state));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    ENTER(c, RC_FMU_ANY);
    NEED(1, size);
    return rc_fmi2_status(rc_fmu_serialised_size(fmu, state, size));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    ENTER(c, RC_FMU_ANY);
    NEED(1, bytes);
    return rc_fmi2_status(rc_fmu_serialise(fmu, state, bytes, size));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state)
{
    ENTER(c, RC_FMU_ANY);
    NEED(1, bytes);
    NEED(1, state);
    return rc_fmi2_status(rc_fmu_deserialise(fmu, bytes, size, state));
}
