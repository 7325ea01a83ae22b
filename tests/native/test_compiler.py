"""The libraries come out the same wherever they are compiled, for every platform."""

import re
import subprocess
from pathlib import Path

import pytest

from fmu_src.native import compiler
from fmu_src.native.compiler import (
    SOURCES,
    TARGETS,
    CompilationError,
    compile_library,
    compile_program,
    this_target,
)
from fmu_src.native.model_sources import MODELS

MAGIC = {".so": b"\x7fELF", ".dll": b"MZ", ".dylib": b"\xcf\xfa\xed\xfe"}


def test_every_source_belongs_to_a_model():
    listed = {name for sources in MODELS.values() for name in sources}
    assert listed == {path.name for path in SOURCES.glob("*.c")}


def elsewhere(folder):
    """A copy of the sources that was never compiled before."""
    folder.mkdir()
    for path in SOURCES.iterdir():
        (folder / path.name).write_bytes(path.read_bytes())
    return folder


def test_same_bytes_from_another_folder(tmp_path, monkeypatch):
    first = compile_library("vehicle", this_target(), name="Vehicle")
    monkeypatch.setattr(compiler, "SOURCES", elsewhere(tmp_path / "sources"))
    assert compile_library("vehicle", this_target(), name="Vehicle") == first


@pytest.mark.slow
@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("model", MODELS)
def test_every_platform(tmp_path, monkeypatch, model, target):
    """Without a warning, as the compiler is told, and without a path.

    Half an hour the first time for Windows, whose whole C library is compiled and kept then.
    """
    first = compile_library(model, target, name="Model")
    assert first.startswith(MAGIC[TARGETS[target].suffix])
    for trace in (SOURCES, Path.home(), tmp_path):
        assert str(trace).encode() not in first
    monkeypatch.setattr(compiler, "SOURCES", elsewhere(tmp_path / "sources"))
    assert compile_library(model, target, name="Model") == first


def test_refused_sources(tmp_path, monkeypatch):
    for name in MODELS["vehicle"]:
        (tmp_path / name).write_text("int unused(void) { int x = 1.5; return 0; }\n")
    monkeypatch.setattr(compiler, "SOURCES", tmp_path)
    with pytest.raises(CompilationError, match="refused the sources"):
        compile_library("vehicle", this_target(), name="Vehicle")


def test_machines_without_a_target(monkeypatch):
    monkeypatch.setattr(compiler.platform, "machine", lambda: "riscv64")
    with pytest.raises(CompilationError, match="no native model for riscv64"):
        this_target()


def test_program(tmp_path):
    """A C program may use a model without any host."""
    source = tmp_path / "say.c"
    source.write_text(
        '#include "model.h"\nint main(void) { return rc_library_class() == NULL ? 1 : 0; }\n'
    )
    program = tmp_path / "say"
    program.write_bytes(compile_program("vehicle", this_target(), main=source))
    program.chmod(0o755)
    assert subprocess.run([program], check=False).returncode == 0


@pytest.mark.parametrize("model", MODELS)
def test_nothing_but_the_c_library_is_needed(model):
    """Names of libraries stand in a library as they are."""
    target = this_target()
    if not target.endswith("linux"):
        pytest.skip("looks into libraries for Linux")
    library = compile_library(model, target, name="Model")
    needed = set(re.findall(rb"lib[\w+-]+\.so[.\d]*", library))
    assert b"libc.so.6" in needed
    assert needed <= {b"libc.so.6", b"libm.so.6"}
