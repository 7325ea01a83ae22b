"""Puts a Python slave, its model and pythonfmu into the contents of an FMU.

FMUs in one process share Python's modules, so the code of a build goes under a package name that
carries the hash of that code: two different builds never see each other's modules. The slave file,
which a host's wrapper executes twice, only names the class; it refuses code of another build.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import distribution
from pathlib import Path
from types import ModuleType
from xml.etree.ElementTree import indent, tostring

import track_fmu
import vehicle_fmu
from fmu_src.archive import content_hash

from .masses_slave import MassesSlave
from .model_slave import ModelSlave
from .track_contact_slave import TrackContactSlave
from .track_slave import TrackSlave
from .vehicle_slave import VehicleSlave

SHARED = (
    "__init__.py",
    "communication_point.py",
    "exception_guard.py",
    "grouped_inputs.py",
    "library_end.py",
    "model_description.py",
    "model_driver.py",
    "model_slave.py",
    "slave_state.py",
    "tables.py",
    "variables.py",
)
TRACK_MODULES = (
    "track_slave.py",
    "track_variables.py",
    "track_parameters.py",
    "track_making.py",
    "track_laws.py",
    "supports.py",
    "support_table.py",
    "basis_cache.py",
)
VEHICLE_MODULES = (
    "vehicle_slave.py",
    "vehicle_variables.py",
    "suspension_variables.py",
    "suspended.py",
    "excitation.py",
)
LIBRARIES = {"linux64": ".so", "win64": ".dll"}  # what pythonfmu provides


@dataclass(frozen=True, slots=True, kw_only=True)
class Recipe:
    """Which code makes up an FMU.

    Attributes
    ----------
    name : str
        Model name and identifier.
    slave : type
        The slave class.
    models : tuple of module
        Packages of the models in it.
    modules : tuple of str
        Files beside those that are shared by all; that of the slave class first.
    """

    name: str
    slave: type[ModelSlave]
    models: tuple[ModuleType, ...]
    modules: tuple[str, ...]


RECIPES = {
    "track": Recipe(
        name="Track",
        slave=TrackSlave,
        models=(track_fmu,),
        modules=TRACK_MODULES,
    ),
    "vehicle": Recipe(
        name="Vehicle",
        slave=VehicleSlave,
        models=(vehicle_fmu,),
        modules=VEHICLE_MODULES,
    ),
    "track_contact": Recipe(
        name="TrackContact",
        slave=TrackContactSlave,
        models=(track_fmu, vehicle_fmu),
        modules=(
            "track_contact_slave.py",
            "track_contact_variables.py",
            *TRACK_MODULES[1:],
            *VEHICLE_MODULES[1:],
        ),
    ),
    "masses": Recipe(
        name="Masses",
        slave=MassesSlave,
        models=(vehicle_fmu,),
        modules=("masses_slave.py", "masses_variables.py", *VEHICLE_MODULES[1:]),
    ),
}

SLAVE_FILE = '''"""The {name} FMU; written by build_fmus.py."""

import {package}
from {package}.slave.{module} import {base}

if {package}.BUILD != "{build}":
    raise ImportError(
        "{name}: code of another build ({package}) is already loaded; start a new process"
    )

# For every instance, pythonfmu 0.7 executes this file and then gives back a reference to its
# namespace that it never took (PythonFMU issue 228); without this one the next instance fails.
globals().setdefault("namespaces", []).append(globals())


class {name}({base}):
    """The slave with the structure that was fixed when it was built."""

    build = "{build}"
{structure}
'''


def fmu_contents(kind: str, structure: Mapping[str, int]) -> dict[str, bytes]:
    """Contents of an FMU by file name.

    Parameters
    ----------
    kind : str
        A key of `RECIPES`.
    structure : mapping of str to int
        Class attributes of the slave: what is fixed when an FMU is built.
    """
    recipe = RECIPES[kind]
    sources = _sources(recipe)
    pythonfmu_sources = {
        f"resources/pythonfmu/{path.name}": path.read_bytes()
        for path in sorted(_installed_pythonfmu().glob("*.py"))
    }
    described = "".join(f"{name}={value};" for name, value in sorted(structure.items()))
    fixed = {"structure": described.encode(), "slave file": SLAVE_FILE.encode()}
    build = content_hash(sources | pythonfmu_sources | _libraries(recipe.name) | fixed)
    package = f"railcosim_{kind}_{build[:12]}"
    module = f"{package}_slave"
    slave = SLAVE_FILE.format(
        name=recipe.name,
        package=package,
        module=recipe.modules[0].removesuffix(".py"),
        base=recipe.slave.__name__,
        build=build,
        structure="\n".join(f"    {name} = {value}" for name, value in sorted(structure.items())),
    )
    contents = {
        f"resources/{package}/{name}": _renamed(data, recipe.models, package)
        for name, data in sources.items()
    }
    contents[f"resources/{package}/__init__.py"] = (
        f'"""Code of the {recipe.name} FMU."""\n\nBUILD = "{build}"\n'.encode()
    )
    contents[f"resources/{module}.py"] = slave.encode()
    contents["resources/slavemodule.txt"] = module.encode()
    contents |= pythonfmu_sources | _libraries(recipe.name)
    contents["modelDescription.xml"] = _description(recipe, structure, build)
    return contents


def _sources(recipe: Recipe) -> dict[str, bytes]:
    """Code of the model and of the slave, by path within the package."""
    slave = Path(__file__).parent
    sources = {
        f"{model.__name__}/{path.name}": path.read_bytes()
        for model in recipe.models
        for path in Path(str(model.__file__)).parent.glob("*.py")
    }
    sources |= {f"slave/{name}": (slave / name).read_bytes() for name in (*SHARED, *recipe.modules)}
    return sources


def _renamed(source: bytes, models: Sequence[ModuleType], package: str) -> bytes:
    """Source with the models' packages imported from within the FMU's own package."""
    names = "|".join(model.__name__ for model in models)
    pattern = rf"^(\s*from )({names})\b"
    return re.sub(pattern, rf"\g<1>{package}.\g<2>", source.decode(), flags=re.MULTILINE).encode()


def _installed_pythonfmu() -> Path:
    """Folder of the installed pythonfmu.

    Where a Python FMU has run, or in a process that such a one has started, `import pythonfmu` may
    find the copy in that FMU, which has no libraries.
    """
    return Path(str(distribution("pythonfmu").locate_file("pythonfmu")))


def _libraries(identifier: str) -> dict[str, bytes]:
    """The wrapper libraries of pythonfmu."""
    folder = _installed_pythonfmu() / "resources" / "binaries"
    return {
        f"binaries/{platform}/{identifier}{suffix}": path.read_bytes()
        for platform, suffix in LIBRARIES.items()
        for path in (folder / platform).glob(f"*{suffix}")
    }


def _description(recipe: Recipe, structure: Mapping[str, int], build: str) -> bytes:
    """Model description, from an instance of the slave with the same structure."""
    slave = type(recipe.name, (recipe.slave,), {"build": build, **structure})
    root = slave(instance_name=recipe.name).to_xml()
    indent(root)
    text: str = tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'.encode()
