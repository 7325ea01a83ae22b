"""The archives: what they hold and claim, and that they are built once."""

import zipfile

import fmpy
import pytest
from fmpy.validation import validate_fmu

from build_fmus import Structure, ensure_fmus, ensure_native_fmus
from fmu_src.native.compiler import this_target


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
        if variable.causality != "independent"
    }


def test_variables_are_those_of_the_python_fmus(native_fmus, tmp_path, small):
    python = ensure_fmus(tmp_path, small)
    for pair in native_fmus.values():
        for one, other in zip(paths_of(pair), paths_of(python), strict=True):
            assert described(one) == described(other)


def test_what_is_there_is_left_alone_and_what_is_damaged_built_again(tmp_path, small):
    built = []
    first = ensure_native_fmus(tmp_path, small, progress=built.append)
    assert built[-1].startswith("building Vehicle")
    before = first.track.read_bytes()
    built.clear()
    ensure_native_fmus(tmp_path, small, progress=built.append)
    assert built == []
    first.track.write_bytes(before[:-1000])
    ensure_native_fmus(tmp_path, small, progress=built.append)
    assert built == [f"building {first.track.name}"]
    assert first.track.read_bytes() == before


def test_another_basis_is_another_file_and_few_are_kept(tmp_path, small):
    usual = ensure_native_fmus(tmp_path, small)
    files = [
        ensure_native_fmus(tmp_path, small, fixed={"pad_stiffness": value}).track
        for value in (1e8, 1.1e8)
    ]
    assert len({usual.track, *files}) == 3
    start = {v.name: v.start for v in fmpy.read_model_description(files[1]).modelVariables}
    assert float(start["pad_stiffness"]) == 1.1e8
    for place in range(9):
        (tmp_path / f"{usual.track.stem}-basis-{place:012x}.fmu").write_bytes(b"")
    newest = ensure_native_fmus(tmp_path, small, fixed={"pad_stiffness": 1.2e8}).track
    kept = list(tmp_path.glob("Track*-basis-*.fmu"))
    assert len(kept) == 8
    assert newest in kept
    assert usual.track.exists()


def test_what_no_track_can_have_is_refused(tmp_path, small):
    with pytest.raises(ValueError, match="ballast_alpha is not fixed in a native track"):
        ensure_native_fmus(tmp_path, small, fixed={"ballast_alpha": 1.0})
    with pytest.raises(ValueError, match="pad_stiffness"):
        ensure_native_fmus(tmp_path, small, fixed={"pad_stiffness": -1.0})


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


def test_sizes_are_in_the_names():
    assert Structure(bays=12, elements_per_bay=4).file_name("track").startswith("Track-12bays")
