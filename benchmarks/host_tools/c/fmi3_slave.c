/* FMI 3.0 for co-simulation, without events and without early return. */
#include "slave.h"

#include <stdio.h>
#include <stdlib.h>

#include "fmi3FunctionTypes.h"

struct host_slave {
    fmi3Instance instance;
    const char *name;
    fmi3EnterInitializationModeTYPE *enter;
    fmi3ExitInitializationModeTYPE *leave;
    fmi3SetFloat64TYPE *set;
    fmi3GetFloat64TYPE *get;
    fmi3DoStepTYPE *step;
    fmi3TerminateTYPE *terminate;
    fmi3FreeInstanceTYPE *release;
};

static void tell(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                 fmi3String message)
{
    (void)environment;
    (void)category;
    fprintf(stderr, "(%d): %s\n", (int)status, message);
}

static void check(const host_slave *slave, fmi3Status status, const char *call)
{
    if (status > fmi3Warning)
        host_fail("%s: %s returned %d", slave->name, call, (int)status);
}

static host_slave *open_slave(const host_archive *archive)
{
    void *library = host_load(archive->library);
    host_slave *slave = host_allocate(sizeof *slave);
    slave->name = archive->name;
    fmi3InstantiateCoSimulationTYPE *instantiate = (fmi3InstantiateCoSimulationTYPE *)host_find(
        library, "fmi3InstantiateCoSimulation");
    slave->enter =
        (fmi3EnterInitializationModeTYPE *)host_find(library, "fmi3EnterInitializationMode");
    slave->leave =
        (fmi3ExitInitializationModeTYPE *)host_find(library, "fmi3ExitInitializationMode");
    slave->set = (fmi3SetFloat64TYPE *)host_find(library, "fmi3SetFloat64");
    slave->get = (fmi3GetFloat64TYPE *)host_find(library, "fmi3GetFloat64");
    slave->step = (fmi3DoStepTYPE *)host_find(library, "fmi3DoStep");
    slave->terminate = (fmi3TerminateTYPE *)host_find(library, "fmi3Terminate");
    slave->release = (fmi3FreeInstanceTYPE *)host_find(library, "fmi3FreeInstance");
    slave->instance = instantiate(archive->name, archive->token, archive->resources, fmi3False,
                                  fmi3False, fmi3False, fmi3False, NULL, 0, NULL, tell, NULL);
    if (slave->instance == NULL)
        host_fail("%s: fmi3InstantiateCoSimulation returned NULL", archive->name);
    return slave;
}

static void enter(host_slave *slave)
{
    check(slave, slave->enter(slave->instance, fmi3False, 0.0, 0.0, fmi3False, 0.0),
          "fmi3EnterInitializationMode");
}

static void leave(host_slave *slave)
{
    check(slave, slave->leave(slave->instance), "fmi3ExitInitializationMode");
}

static void set(host_slave *slave, unsigned reference, double value)
{
    check(slave, slave->set(slave->instance, &reference, 1, &value, 1), "fmi3SetFloat64");
}

static double get(host_slave *slave, unsigned reference)
{
    double value;
    check(slave, slave->get(slave->instance, &reference, 1, &value, 1), "fmi3GetFloat64");
    return value;
}

static void step(host_slave *slave, double time, double size)
{
    fmi3Boolean event = fmi3False, terminate = fmi3False, early = fmi3False;
    double reached = time;
    check(slave,
          slave->step(slave->instance, time, size, fmi3True, &event, &terminate, &early, &reached),
          "fmi3DoStep");
    if (early || terminate)
        host_fail("%s: the step at %g s ended early, at %g s", slave->name, time, reached);
}

static void close_slave(host_slave *slave)
{
    check(slave, slave->terminate(slave->instance), "fmi3Terminate");
    slave->release(slave->instance);
    free(slave);
}

const host_version host_fmi3 = {open_slave, enter, leave, set, get, step, close_slave};
