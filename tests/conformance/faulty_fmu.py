"""The FMU of faulty.c: `fmi2Error` and last successful times are out of pythonfmu's reach."""

import subprocess
import sys
import zipfile
from pathlib import Path

from fmpy import platform, sharedLibraryExtension

source = Path(__file__).with_name("faulty.c")

faults = {"discard": 1, "error": 2, "fatal": 3, "nan": 4, "crash": 5, "hang": 6}
"""Values of the parameter `fault`."""

description = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Faulty" guid="faulty-1">
  <CoSimulation modelIdentifier="faulty" canHandleVariableCommunicationStepSize="true"
                canGetAndSetFMUstate="true" canSerializeFMUstate="true"/>
  <ModelVariables>
    <ScalarVariable name="u" valueReference="0" causality="input"><Real start="0"/></ScalarVariable>
    <ScalarVariable name="y" valueReference="1" causality="output" initial="exact">
      <Real start="1"/></ScalarVariable>
    <ScalarVariable name="fault" valueReference="2" causality="parameter" variability="fixed">
      <Integer start="0"/></ScalarVariable>
    <ScalarVariable name="call" valueReference="3" causality="parameter" variability="fixed">
      <String start="doStep"/></ScalarVariable>
    <ScalarVariable name="times" valueReference="4" causality="parameter" variability="fixed">
      <Integer start="-1"/></ScalarVariable>
    <ScalarVariable name="start" valueReference="5" causality="parameter" variability="fixed">
      <Real start="0"/></ScalarVariable>
    <ScalarVariable name="reported" valueReference="6" causality="parameter" variability="fixed">
      <Real start="0"/></ScalarVariable>
    <ScalarVariable name="linear_inputs" valueReference="7" causality="parameter"
                    variability="fixed"><Boolean start="false"/></ScalarVariable>
    <ScalarVariable name="witness" valueReference="8" causality="parameter" variability="fixed">
      <String start=""/></ScalarVariable>
  </ModelVariables>
  <ModelStructure>
    <Outputs><Unknown index="2"/></Outputs>
  </ModelStructure>
</fmiModelDescription>
"""


def build(folder):
    """Build faulty.fmu."""
    library = folder / f"faulty{sharedLibraryExtension}"
    options = ["-shared", "-fPIC", "-O1", "-Wall", "-Wextra", "-Werror", "-fvisibility=hidden"]
    subprocess.run(
        [sys.executable, "-m", "ziglang", "cc", *options, "-o", library, source, "-lm"], check=True
    )
    with zipfile.ZipFile(folder / "faulty.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", description)
        archive.write(library, f"binaries/{platform}/{library.name}")
