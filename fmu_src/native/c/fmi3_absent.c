/* FMI 3.0: functions that must be there but that these FMUs have no use for. They have neither
 * variables of other types nor clocks, events, structural parameters or continuous states. */
#include "fmi3.h"

#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

static fmi3Status absent(rc_fmu *fmu, const char *call)
{
    if (fmu == NULL)
        return fmi3Error;
    return rc_fmi3_status(rc_fmu_refuse(fmu, RC_ERROR, "%s: this FMU has nothing of that kind",
                                        call));
}

#define ABSENT(name, ...)                                               \
    fmi3Status name(fmi3Instance instance, __VA_ARGS__)                 \
    {                                                                   \
        return absent(instance, #name);                                 \
    }
#define ABSENT_MODE(name)                                               \
    fmi3Status name(fmi3Instance instance)                              \
    {                                                                   \
        return absent(instance, #name);                                 \
    }
#define REFERENCES const fmi3ValueReference vr[], size_t n

/* Nothing of a type is what there is of it: a host may ask for that. */
#define NONE_OF(type)                                                                           \
    fmi3Status fmi3Get##type(fmi3Instance instance, REFERENCES, fmi3##type values[],            \
                             size_t n_values)                                                   \
    {                                                                                           \
        return instance != NULL && n == 0 && n_values == 0 ? fmi3OK                             \
                                                           : absent(instance, "fmi3Get" #type); \
    }                                                                                           \
    fmi3Status fmi3Set##type(fmi3Instance instance, REFERENCES, const fmi3##type values[],      \
                             size_t n_values)                                                   \
    {                                                                                           \
        return instance != NULL && n == 0 && n_values == 0 ? fmi3OK                             \
                                                           : absent(instance, "fmi3Set" #type); \
    }

NONE_OF(Float32)
NONE_OF(Int8)
NONE_OF(UInt8)
NONE_OF(Int16)
NONE_OF(UInt16)
NONE_OF(UInt32)
NONE_OF(Int64)
NONE_OF(UInt64)
ABSENT(fmi3GetBinary, REFERENCES, size_t sizes[], fmi3Binary values[], size_t n_values)
ABSENT(fmi3SetBinary, REFERENCES, const size_t sizes[], const fmi3Binary values[], size_t n_values)

ABSENT(fmi3GetClock, REFERENCES, fmi3Clock values[])
ABSENT(fmi3SetClock, REFERENCES, const fmi3Clock values[])
ABSENT(fmi3GetIntervalDecimal, REFERENCES, fmi3Float64 intervals[],
       fmi3IntervalQualifier qualifiers[])
ABSENT(fmi3GetIntervalFraction, REFERENCES, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
       fmi3IntervalQualifier qualifiers[])
ABSENT(fmi3GetShiftDecimal, REFERENCES, fmi3Float64 shifts[])
ABSENT(fmi3GetShiftFraction, REFERENCES, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
ABSENT(fmi3SetIntervalDecimal, REFERENCES, const fmi3Float64 intervals[])
ABSENT(fmi3SetIntervalFraction, REFERENCES, const fmi3UInt64 counters[],
       const fmi3UInt64 resolutions[])
ABSENT(fmi3SetShiftDecimal, REFERENCES, const fmi3Float64 shifts[])
ABSENT(fmi3SetShiftFraction, REFERENCES, const fmi3UInt64 counters[],
       const fmi3UInt64 resolutions[])
ABSENT(fmi3ActivateModelPartition, fmi3ValueReference clock, fmi3Float64 time)

ABSENT_MODE(fmi3EnterEventMode)
ABSENT_MODE(fmi3EnterStepMode)
ABSENT_MODE(fmi3EnterConfigurationMode)
ABSENT_MODE(fmi3ExitConfigurationMode)
ABSENT_MODE(fmi3EnterContinuousTimeMode)
ABSENT_MODE(fmi3EvaluateDiscreteStates)
ABSENT(fmi3UpdateDiscreteStates, fmi3Boolean *again, fmi3Boolean *terminate,
       fmi3Boolean *nominals_changed, fmi3Boolean *states_changed, fmi3Boolean *has_next,
       fmi3Float64 *next)

ABSENT(fmi3GetNumberOfVariableDependencies, fmi3ValueReference reference, size_t *count)
ABSENT(fmi3GetVariableDependencies, fmi3ValueReference dependent, size_t dependent_elements[],
       fmi3ValueReference independents[], size_t independent_elements[],
       fmi3DependencyKind kinds[], size_t count)

ABSENT(fmi3CompletedIntegratorStep, fmi3Boolean no_way_back, fmi3Boolean *event_mode,
       fmi3Boolean *terminate)
ABSENT(fmi3SetTime, fmi3Float64 time)
ABSENT(fmi3SetContinuousStates, const fmi3Float64 states[], size_t count)
ABSENT(fmi3GetContinuousStates, fmi3Float64 states[], size_t count)
ABSENT(fmi3GetContinuousStateDerivatives, fmi3Float64 derivatives[], size_t count)
ABSENT(fmi3GetNominalsOfContinuousStates, fmi3Float64 nominals[], size_t count)
ABSENT(fmi3GetEventIndicators, fmi3Float64 indicators[], size_t count)
ABSENT(fmi3GetNumberOfContinuousStates, size_t *count)
ABSENT(fmi3GetNumberOfEventIndicators, size_t *count)
