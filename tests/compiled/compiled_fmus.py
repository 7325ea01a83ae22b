"""FMUs in C that the tests compile: three small models, and one with every type of FMI 3.0."""

import subprocess
import sys
import tempfile
import zipfile
from functools import cache
from pathlib import Path
from typing import NamedTuple
from xml.sax.saxutils import quoteattr

import fmpy

sources = Path(__file__).parent
headers = Path(fmpy.__file__).parent / "c-code"


class Entry(NamedTuple):
    """A variable of a model description, its type as FMI 3.0 names it."""

    name: str
    type: str = "Float64"
    causality: str = "parameter"
    start: str | None = None
    size: tuple[int, ...] = ()
    depends_on: tuple[int, ...] = ()


def real(name, causality="parameter", start=None, **more):
    return Entry(name, "Float64", causality, start, **more)


mass = (
    real("force", "input", "0"),
    real("x", "output"),
    real("v", "output"),
    real("a", "output", depends_on=(0,)),
    real("mass", start="1"),
    Entry("steps", "Int32", "output"),
    Entry("trouble", "Int32", start="0"),
    Entry("moving", "Boolean", "output"),
    Entry("linear_inputs", "Boolean", start="false"),
)
gain = (
    real("u", "input", "0"),
    real("y", "output", depends_on=(0,)),
    real("gain", start="1"),
)
integrator = (
    real("u", "input", "0"),
    real("y", "output", depends_on=(0,)),
    real("gain", start="0"),
    real("rate", start="1"),
    real("start", start="0"),
)
integers = [f"{sign}Int{bits}" for bits in (8, 16, 32, 64) for sign in ("", "U")]
types = (
    real("u", "input", "10 20 30", size=(3,)),
    real("y", "output", size=(2,), depends_on=(0,)),
    real("gain", start="1 2 3 4 5 6", size=(2, 3)),
    Entry("w", "Float32", "input", "0"),
    Entry("z", "Float32", "output", depends_on=(3,)),
    *(
        entry
        for name in integers
        for entry in (Entry(f"p_{name}", name, start="0"), Entry(f"o_{name}", name, "output"))
    ),
    Entry("flags", "Boolean", start="false", size=(2,)),
    Entry("mirror", "Boolean", "output", size=(2,)),
)
models = {"mass": mass, "gain": gain, "integrator": integrator, "types": types}
fmi2_types = {"Float64": "Real", "Int32": "Integer", "Boolean": "Boolean"}


def build(folder, name, *, fmi_version=2, model="mass", **claims):
    """Write an FMU and return its path.

    The library is compiled once per process, for every model and version.

    Parameters
    ----------
    folder : pathlib.Path
        Where the FMU goes.
    name : str
        Its model name.
    fmi_version : {2, 3}
        2.0 or 3.0.
    model : {'mass', 'gain', 'integrator', 'types'}
        ``types`` is for FMI 3.0 only.
    **claims
        Attributes of CoSimulation in place of the usual ones, as FMI 2.0 names them.
    """
    path = folder / f"{name}.fmu"
    platform = fmpy.platform if fmi_version == 2 else fmpy.platform_tuple
    library = f"binaries/{platform}/{model}{fmpy.sharedLibraryExtension}"
    describe = describe_fmi2 if fmi_version == 2 else describe_fmi3
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", describe(name, model, claims))
        archive.writestr(library, compiled(model, fmi_version))
    return path


@cache
def compiled(model, fmi_version):
    """Return the bytes of a shared library."""
    files = [f"{model}.c", f"fmi{fmi_version}.c"] + ["fmi3_absent.c"] * (fmi_version == 3)
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "library"
        options = ["-shared", "-fPIC", "-O2", "-Wall", "-Werror", f"-I{headers}"]
        compiler = [sys.executable, "-m", "ziglang", "cc"]
        command = [*compiler, *options, *(str(sources / file) for file in files), "-lm"]
        done = subprocess.run(
            [*command, "-o", str(library)], capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return library.read_bytes()


usual = {
    "canHandleVariableCommunicationStepSize": True,
    "canGetAndSetFMUstate": True,
    "canSerializeFMUstate": True,
    "providesDirectionalDerivative": True,
}
fmi3_names = {
    "canGetAndSetFMUstate": "canGetAndSetFMUState",
    "canSerializeFMUstate": "canSerializeFMUState",
    "providesDirectionalDerivative": "providesDirectionalDerivatives",
}


def describe_fmi2(name, model, claims):
    claims = {**usual, "canInterpolateInputs": True, **claims}
    entries = models[model]
    variables = []
    for reference, entry in enumerate(entries):
        value = attributes(start=entry.start) if entry.start is not None else ""
        variables.append(
            f"<ScalarVariable{common(reference, entry)}>"
            f"<{fmi2_types[entry.type]}{value}/></ScalarVariable>"
        )
    unknowns = "".join(
        f'<Unknown index="{place + 1}" dependencies="{listed(entry, offset=1)}"/>'
        for place, entry in enumerate(entries)
        if entry.causality == "output"
    )
    return (
        f'<fmiModelDescription fmiVersion="2.0"{attributes(modelName=name, guid=model)}>'
        f"<CoSimulation{attributes(modelIdentifier=model, **claims)}/>"
        f"<ModelVariables>{''.join(variables)}</ModelVariables><ModelStructure>"
        f"<Outputs>{unknowns}</Outputs><InitialUnknowns>{unknowns}</InitialUnknowns>"
        "</ModelStructure></fmiModelDescription>"
    )


def describe_fmi3(name, model, claims):
    claims = {fmi3_names.get(key, key): value for key, value in {**usual, **claims}.items()}
    entries = models[model]
    variables = []
    for reference, entry in enumerate(entries):
        value = attributes(start=entry.start) if entry.start is not None else ""
        sizes = "".join(f'<Dimension start="{size}"/>' for size in entry.size)
        variables.append(f"<{entry.type}{common(reference, entry)}{value}>{sizes}</{entry.type}>")
    structure = "".join(
        f'<{kind} valueReference="{place}" dependencies="{listed(entry, offset=0)}"/>'
        for kind in ("Output", "InitialUnknown")
        for place, entry in enumerate(entries)
        if entry.causality == "output"
    )
    independent = (
        f'<Float64 name="time" valueReference="{len(entries)}" causality="independent" '
        'variability="continuous"/>'
    )
    return (
        f'<fmiModelDescription fmiVersion="3.0"{attributes(modelName=name)}'
        f"{attributes(instantiationToken=model)}>"
        f"<CoSimulation{attributes(modelIdentifier=model, **claims)}/>"
        f"<ModelVariables>{independent}{''.join(variables)}</ModelVariables>"
        f"<ModelStructure>{structure}</ModelStructure></fmiModelDescription>"
    )


def common(reference, entry):
    variability = "fixed" if entry.causality == "parameter" else "continuous"
    if entry.type not in {"Float64", "Float32"} and entry.causality != "parameter":
        variability = "discrete"
    return attributes(
        name=entry.name,
        valueReference=reference,
        causality=entry.causality,
        variability=variability,
    )


def listed(entry, *, offset):
    return " ".join(str(place + offset) for place in entry.depends_on)


def attributes(**values):
    words = {True: "true", False: "false"}
    return "".join(
        f" {key}={quoteattr(words[value] if isinstance(value, bool) else str(value))}"
        for key, value in values.items()
    )
