/* What the functions of FMI 2.0 share. */
#ifndef RC_FMI2_H
#define RC_FMI2_H

#include "fmi2Functions.h"

#include "fmu.h"

static inline fmi2Status rc_fmi2_status(rc_status status)
{
    return status == RC_OK ? fmi2OK : status == RC_DISCARD ? fmi2Discard : fmi2Error;
}

/* The instance `fmu`, if the call is allowed in its present phase. */
#define ENTER(component, phases)                                        \
    rc_fmu *const fmu = (component);                                    \
    if (fmu == NULL || rc_fmu_expect(fmu, __func__, phases) != RC_OK)   \
    return fmi2Error

/* An argument that must be there if the count is not 0. */
#define NEED(count, argument)                                           \
    do {                                                                \
        if (rc_fmu_need(fmu, __func__, count, argument) != RC_OK)       \
            return fmi2Error;                                           \
    } while (0)

#endif
