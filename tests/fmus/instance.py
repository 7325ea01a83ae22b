"""An FMI 2.0 instance whose variables are known by name, for tests without the orchestrator."""

import shutil

from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    defaultCallbacks,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2LastSuccessfulTime,
)

SETTERS = {"Real": "setReal", "Integer": "setInteger", "Boolean": "setBoolean"}


class Instance:
    def __init__(self, path, *, name="slave", initialise=True, **values):
        self.description = read_model_description(path)
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.folder = extract(str(path))
        self.messages = []
        self.dead = False
        self.fmu = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.fmu.instantiate(callbacks=self._callbacks(), loggingOn=True)
        self.fmu.setupExperiment(startTime=0.0)
        for variable, value in values.items():
            self.set(variable, value)
        if initialise:
            self.initialise()

    def _callbacks(self):
        def log(_environment, _name, _status, _category, message):
            self.messages.append(message.decode())

        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(log)
        callbacks.allocateMemory = defaultCallbacks.allocateMemory
        callbacks.freeMemory = defaultCallbacks.freeMemory
        return callbacks

    def initialise(self):
        try:
            self.fmu.enterInitializationMode()
            self.fmu.exitInitializationMode()
        except FMICallException:
            self.dead = True
            raise

    def set(self, name, value):
        variable = self.variables[name]
        setter = getattr(self.fmu, SETTERS.get(variable.type, "setString"))
        setter([variable.valueReference], [value])

    def get(self, name):
        getter = "getBoolean" if self.variables[name].type == "Boolean" else "getReal"
        return getattr(self.fmu, getter)([self.variables[name].valueReference])[0]

    def outputs(self):
        names = [
            v.name
            for v in self.description.modelVariables
            if v.causality == "output" and v.type == "Real"
        ]
        return self.fmu.getReal([self.variables[name].valueReference for name in names])

    def last_successful_time(self):
        return self.fmu.getRealStatus(fmi2LastSuccessfulTime)

    def close(self):
        if not self.dead:  # the wrapper of a dead Python slave crashes when it is freed
            self.fmu.terminate()
            self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)
