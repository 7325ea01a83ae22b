/* FMI 2.0 for co-simulation. */
#include "slave.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi2FunctionTypes.h"

struct host_slave {
    fmi2Component component;
    const char *name;
    fmi2CallbackFunctions callbacks;
    fmi2SetupExperimentTYPE *setup;
    fmi2EnterInitializationModeTYPE *enter;
    fmi2ExitInitializationModeTYPE *leave;
    fmi2SetRealTYPE *set;
    fmi2GetRealTYPE *get;
    fmi2DoStepTYPE *step;
    fmi2TerminateTYPE *terminate;
    fmi2FreeInstanceTYPE *release;
};

static void tell(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                 fmi2String category, fmi2String message, ...)
{
    (void)environment;
    (void)category;
    va_list values;
    va_start(values, message);
    fprintf(stderr, "%s (%d): ", name, (int)status);
    vfprintf(stderr, message, values);
    fputc('\n', stderr);
    va_end(values);
}

static void check(const host_slave *slave, fmi2Status status, const char *call)
{
    if (status > fmi2Warning)
        host_fail("%s: %s returned %d", slave->name, call, (int)status);
}

static host_slave *open_slave(const host_archive *archive)
{
    void *library = host_load(archive->library);
    host_slave *slave = host_allocate(sizeof *slave);
    slave->name = archive->name;
    slave->callbacks =
        (fmi2CallbackFunctions){.logger = tell, .allocateMemory = calloc, .freeMemory = free};
    fmi2InstantiateTYPE *instantiate =
        (fmi2InstantiateTYPE *)host_find(library, "fmi2Instantiate");
    slave->setup = (fmi2SetupExperimentTYPE *)host_find(library, "fmi2SetupExperiment");
    slave->enter =
        (fmi2EnterInitializationModeTYPE *)host_find(library, "fmi2EnterInitializationMode");
    slave->leave =
        (fmi2ExitInitializationModeTYPE *)host_find(library, "fmi2ExitInitializationMode");
    slave->set = (fmi2SetRealTYPE *)host_find(library, "fmi2SetReal");
    slave->get = (fmi2GetRealTYPE *)host_find(library, "fmi2GetReal");
    slave->step = (fmi2DoStepTYPE *)host_find(library, "fmi2DoStep");
    slave->terminate = (fmi2TerminateTYPE *)host_find(library, "fmi2Terminate");
    slave->release = (fmi2FreeInstanceTYPE *)host_find(library, "fmi2FreeInstance");
    slave->component = instantiate(archive->name, fmi2CoSimulation, archive->token,
                                   archive->resources, &slave->callbacks, fmi2False, fmi2False);
    if (slave->component == NULL)
        host_fail("%s: fmi2Instantiate returned NULL", archive->name);
    check(slave, slave->setup(slave->component, fmi2False, 0.0, 0.0, fmi2False, 0.0),
          "fmi2SetupExperiment");
    return slave;
}

static void enter(host_slave *slave)
{
    check(slave, slave->enter(slave->component), "fmi2EnterInitializationMode");
}

static void leave(host_slave *slave)
{
    check(slave, slave->leave(slave->component), "fmi2ExitInitializationMode");
}

static void set(host_slave *slave, unsigned reference, double value)
{
    check(slave, slave->set(slave->component, &reference, 1, &value), "fmi2SetReal");
}

static double get(host_slave *slave, unsigned reference)
{
    double value;
    check(slave, slave->get(slave->component, &reference, 1, &value), "fmi2GetReal");
    return value;
}

static void step(host_slave *slave, double time, double size)
{
    check(slave, slave->step(slave->component, time, size, fmi2True), "fmi2DoStep");
}

static void close_slave(host_slave *slave)
{
    check(slave, slave->terminate(slave->component), "fmi2Terminate");
    slave->release(slave->component);
    free(slave);
}

const host_version host_fmi2 = {open_slave, enter, leave, set, get, step, close_slave};
