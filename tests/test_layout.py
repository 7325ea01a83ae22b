"""Who may import whom, and that one place says each fact about the project."""

import ast
import re
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
OURS = {"track_fmu", "vehicle_fmu", "fmu_src", "orchestrator", "railcosim", "build_fmus"}
MODELS = {"track_fmu", "vehicle_fmu"}
PYTHON = sys.stdlib_module_names | {"_typeshed"}  # the latter only for type checkers

MAY_IMPORT = {
    "track_fmu": {"numpy", "scipy"},
    "vehicle_fmu": {"numpy", "scipy"},
    "fmu_src": {"numpy", "scipy", "fmpy", "platformdirs", "pythonfmu", *MODELS},
    "orchestrator": {"numpy", "scipy", "fmpy", "lxml"},
    "build_fmus": {"fmu_src"},
    "railcosim": {
        *(OURS - {"railcosim", "build_fmus"}),
        "dask",
        "distributed",
        "fmpy",
        "h5netcdf",
        "jinja2",
        "markupsafe",
        "matplotlib",
        "numpy",
        "pandas",
        "plotly",
        "pyarrow",
        "pytest",
        "rich",
        "scipy",
        "threadpoolctl",
        "typer",
        "xarray",
    },
    "docs": {"fmu_src", "latex2mathml", "mkdocs"},
    "examples": {"fmpy", "matplotlib", "numpy"},
}
"""Who may import what besides the standard library and itself."""


@dataclass(frozen=True)
class Import:
    """An import statement: the file, the module it names, and whether it is relative."""

    file: Path
    module: str
    relative: bool

    @property
    def top(self):
        return self.module.partition(".")[0]


def imports_in(source, file=Path("x.py")):
    """Every import of a source, those inside functions and under TYPE_CHECKING included."""
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found += [Import(file, name.name, relative=False) for name in node.names]
        elif isinstance(node, ast.ImportFrom):
            found.append(Import(file, node.module or "", relative=node.level > 0))
    return found


def files_of(part):
    return sorted((ROOT / part).rglob("*.py")) if (ROOT / part).is_dir() else [ROOT / f"{part}.py"]


def imports_of(part):
    return [
        item
        for file in files_of(part)
        for item in imports_in(file.read_text(encoding="utf-8"), file.relative_to(ROOT))
    ]


def foreign(part):
    """Absolute imports of other things than the standard library and the part itself."""
    return [
        item
        for item in imports_of(part)
        if not item.relative and item.top != part and item.top not in PYTHON
    ]


def test_imports_are_found_wherever_they_stand():
    source = (
        "import a.b\ndef f():\n    from c.d import e\n    from .g import h\n    from . import i"
    )
    assert [(item.top, item.relative) for item in imports_in(source)] == [
        ("a", False),
        ("c", False),
        ("g", True),
        ("", True),
    ]


@pytest.mark.parametrize("part", sorted(OURS))
def test_every_part_is_there(part):
    assert len(imports_of(part)) > 0


@pytest.mark.parametrize("part", sorted(MAY_IMPORT))
def test_a_part_imports_only_what_it_may(part):
    assert [item for item in foreign(part) if item.top not in MAY_IMPORT[part]] == []


def test_nothing_may_import_the_application():
    assert [part for part, allowed in MAY_IMPORT.items() if "railcosim" in allowed] == []


def test_a_module_of_the_fmu_layer_knows_one_model_at_most():
    """But for what belongs to the one FMU made of both, and the list of what is built of what."""
    both = {
        file.name
        for file in files_of("fmu_src")
        if {item.top for item in imports_in(file.read_text(encoding="utf-8"))} >= MODELS
    }
    assert both <= {"packaging.py", "track_contact_slave.py", "track_contact_variables.py"}


@pytest.mark.parametrize("part", [*sorted(MODELS), "orchestrator", "railcosim"])
def test_a_package_imports_itself_by_relative_imports(part):
    """A model is copied into its FMU under another name; the others keep to the same habit."""
    assert [item for item in imports_of(part) if item.top == part and not item.relative] == []


def test_every_library_in_use_is_declared_and_every_declared_one_is_used():
    project = project_file()["project"]
    optional = project["optional-dependencies"]
    extras = [line for name in ("parquet", "pytest", "report", "sweep") for line in optional[name]]
    names = [re.split(r"[\[<>=! ]", line)[0] for line in [*project["dependencies"], *extras]]
    behind_xarray = {"h5py"}  # which writes its files through it
    used = {item.top for part in OURS for item in foreign(part)} - OURS
    assert set(names) - behind_xarray == used


def test_one_version_everywhere():
    version = project_file()["project"]["version"]
    assert f'__version__ = "{version}"' in text_of("railcosim/__init__.py")
    assert f"version: {version}\n" in text_of("CITATION.cff")


def text_of(name):
    return (ROOT / name).read_text(encoding="utf-8")


def project_file():
    return tomllib.loads(text_of("pyproject.toml"))
