/* What the functions of FMI 3.0 share. */
#ifndef RC_FMI3_H
#define RC_FMI3_H

#include "fmi3Functions.h"

#include "fmu.h"

static inline fmi3Status rc_fmi3_status(rc_status status)
{
    return status == RC_OK ? fmi3OK : status == RC_DISCARD ? fmi3Discard : fmi3Error;
}

/* The instance `fmu`, if the call is allowed in its present phase. */
#define ENTER(instance, phases)                                         \
    rc_fmu *const fmu = (instance);                                     \
    if (fmu == NULL || rc_fmu_expect(fmu, __func__, phases) != RC_OK)   \
    return fmi3Error

/* An argument that must be there if the count is not 0. */
#define NEED(count, argument)                                           \
    do {                                                                \
        if (rc_fmu_need(fmu, __func__, count, argument) != RC_OK)       \
            return fmi3Error;                                           \
    } while (0)

/* Two counts that must be the same: of the values that the variables have, and of those given. */
#define MATCH(one, other)                                               \
    do {                                                                \
        if ((one) != (other))                                           \
            return rc_fmi3_status(rc_fmu_refuse(                        \
                fmu, RC_ERROR, "%s was called with %zu values in place of %zu", __func__, \
                (size_t)(other), (size_t)(one)));                       \
    } while (0)

#endif
