"""The archives: what they hold and claim, and where each version wants it."""

import ctypes
import io
import struct
import subprocess
import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
import matplotlib.image
import pytest
from fmpy.validation import validate_fmu
from lxml import etree

from fmu_src.building import ensure_fmus
from fmu_src.native import packaging
from fmu_src.native.compiler import TARGETS, this_target
from fmu_src.native.models import native_vehicle
from fmu_src.native.packaging import fmu_contents
from orchestrator import check_fmu


def paths_of(pair):
    return (pair.track, pair.vehicle)


def test_every_archive_keeps_to_the_standard(native_fmus):
    for pair in native_fmus.values():
        for path in paths_of(pair):
            assert validate_fmu(str(path)) == []


def described(path):
    return {
        variable.name: (
            variable.valueReference,
            variable.unit,
            variable.description,
            variable.min and float(variable.min),
            variable.nominal and float(variable.nominal),
        )
        for variable in fmpy.read_model_description(path).modelVariables
        if variable.causality != "independent" and not variable.dimensions
    }


def test_variables_are_those_of_the_python_fmus(native_fmus, tmp_path, small):
    python = ensure_fmus(tmp_path, small)
    for pair in native_fmus.values():
        for one, other in zip(paths_of(pair), paths_of(python), strict=True):
            assert described(one) == described(other)


def test_libraries_resources_and_sources_are_where_each_version_wants_them(native_fmus):
    folders = {2: fmpy.platform, 3: this_target()}
    for version, pair in native_fmus.items():
        for path in paths_of(pair):
            names = set(zipfile.ZipFile(path).namelist())
            library = path.stem.partition("-")[0] + fmpy.sharedLibraryExtension
            assert f"binaries/{folders[version]}/{library}" in names
            assert {
                "resources/model.bin",
                "resources/build.txt",
                "documentation/index.html",
            } < names
            assert f"sources/fmi{version}.c" in names
            assert not any(name.startswith(f"sources/fmi{5 - version}") for name in names)


FOLDERS = {
    2: {"linux64/Vehicle.so", "win64/Vehicle.dll", "darwin64/Vehicle.dylib"},
    3: {
        "x86_64-linux/Vehicle.so",
        "aarch64-linux/Vehicle.so",
        "x86_64-windows/Vehicle.dll",
        "x86_64-darwin/Vehicle.dylib",
        "aarch64-darwin/Vehicle.dylib",
    },
}


@pytest.mark.parametrize("version", [2, 3])
def test_every_platform_has_its_folder(monkeypatch, version):
    """With stand-ins for the libraries; compiling for every platform is a test of the compiler."""

    def stand_in(_model, target, **_):
        head = struct.pack("<Iii", 0xFEEDFACF, len(target), 0)
        return head + target.encode() if "darwin" in target else target.encode()

    monkeypatch.setattr(packaging, "cached_library", stand_in)
    found = fmu_contents(native_vehicle(wheels=1), fmi_version=version)
    libraries = {name[9:]: data for name, data in found.items() if name.startswith("binaries/")}
    assert set(libraries) == FOLDERS[version]
    if version == 3:
        assert all(name.split("/")[0].encode() in data for name, data in libraries.items())
    else:
        both = libraries["darwin64/Vehicle.dylib"]
        count, slices = struct.unpack_from(">II", both)[1], []
        for place in range(count):
            kind, _, first, size, _ = struct.unpack_from(">iiIII", both, 8 + 20 * place)
            assert first % 2**14 == 0
            assert kind == len(both[first + 12 : first + size])
            slices.append(both[first + 12 : first + size])
        assert slices == [b"x86_64-darwin", b"aarch64-darwin"]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="looks at libraries for Linux")
def test_a_library_needs_libc_and_libm_alone(unpacked):
    for folder in unpacked.values():
        (library,) = folder.glob("binaries/*/*.so")
        done = subprocess.run(["ldd", library], capture_output=True, text=True, check=True)
        needed = {line.split()[0].split("/")[-1] for line in done.stdout.splitlines()}
        assert needed <= {"linux-vdso.so.1", "libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2"}


@pytest.mark.parametrize(("version", "model"), [(2, "vehicle"), (3, "track")])
def test_a_host_can_compile_the_sources(unpacked, tmp_path, version, model):
    """As the description says, without the project's own options."""
    sources = unpacked[version, model] / "sources"
    file, kind = {
        2: ("../modelDescription.xml", "File"),
        3: ("buildDescription.xml", "SourceFile"),
    }[version]
    listed = ET.parse(sources / file).getroot().iter(kind)  # noqa: S314 - our own
    files = [item.get("name") for item in listed]
    assert set(files) == {path.name for path in sources.glob("*.c")}
    library = tmp_path / "library"
    compiler = [sys.executable, "-m", "ziglang", "cc", "-target", TARGETS[this_target()].triple]
    options = ["-O2", "-shared", "-fPIC", "-I.", "-lm", "-o", str(library)]
    subprocess.run([*compiler, *files, *options], cwd=sources, check=True)
    version_of = getattr(ctypes.CDLL(str(library)), f"fmi{version}GetVersion")
    version_of.restype = ctypes.c_char_p
    assert version_of() == f"{version}.0".encode()


def test_terminals_name_variables_and_keep_to_the_schema(unpacked):
    schemas = Path(fmpy.__file__).parent / "schema" / "fmi3"
    for file, schema in (
        ("terminalsAndIcons/terminalsAndIcons.xml", "fmi3TerminalsAndIcons.xsd"),
        ("sources/buildDescription.xml", "fmi3BuildDescription.xsd"),
    ):
        for model in ("track", "vehicle"):
            tree = etree.parse(str(unpacked[3, model] / file))
            etree.XMLSchema(etree.parse(str(schemas / schema))).assertValid(tree)
    ends = []
    for model in ("track", "vehicle"):
        known = {
            v.name for v in fmpy.read_model_description(str(unpacked[3, model])).modelVariables
        }
        tree = etree.parse(str(unpacked[3, model] / "terminalsAndIcons/terminalsAndIcons.xml"))
        members = tree.findall(".//TerminalMemberVariable")
        assert {item.get("variableName") for item in members} < known
        ends.append([item.get("memberName") for item in members])
    assert ends[0] == ends[1], "plugs fit"
    assert len(ends[0]) == 6
    icon = (unpacked[3, "track"] / "terminalsAndIcons" / "icon.png").read_bytes()
    assert icon[:8] == b"\x89PNG\r\n\x1a\n"
    assert matplotlib.image.imread(io.BytesIO(icon)).shape == (64, 64, 3)


@pytest.mark.parametrize(
    ("version", "model"),
    [
        (2, "track"),
        (3, "vehicle"),
        pytest.param(2, "vehicle", marks=pytest.mark.slow),
        pytest.param(3, "track", marks=pytest.mark.slow),
    ],
)
def test_everything_that_they_claim_holds(native_fmus, version, model):
    verdicts = check_fmu(getattr(native_fmus[version], model))
    assert [item for item in verdicts if not item.holds] == []
    assert len(verdicts) == 6
