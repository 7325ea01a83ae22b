"""Compiles the C models into shared libraries for every platform, with the `ziglang` wheel.

The same sources and the same version of ziglang give the same bytes, wherever they are compiled:
no path, no time and no identification of the build gets into a library.
"""

from __future__ import annotations

import platform
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import fmpy

from .model_sources import MODELS

SOURCES = Path(__file__).parent / "c"
HEADERS = Path(str(fmpy.__file__)).parent / "c-code"
"""Headers of both versions of FMI."""

LANGUAGE = ("-std=c11", "-Wall", "-Wextra", "-Wconversion", "-Wpedantic", "-Wshadow", "-Werror")
ARITHMETIC = ("-O3", "-ffp-contract=off", "-fno-math-errno")
"""Products and sums are rounded one by one on every machine; nothing else may be reordered."""
REPRODUCIBLE = ("-g0", "-s", "-fno-ident", "-fvisibility=hidden")

TIME_LIMIT = 3600.0  # s; the first call for Windows compiles its C library too, for minutes


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """A platform to compile for.

    Attributes
    ----------
    triple : str
        What ziglang calls it, with the oldest C library it shall run on.
    folder : str
        Folder of its libraries in an FMU of FMI 2.0, "" where that names none; that of FMI 3.0 is
        the key of `TARGETS`.
    suffix : str
        End of a library's name.
    options : tuple of str
        For the linker.
    """

    triple: str
    folder: str
    suffix: str
    options: tuple[str, ...] = ()


_LINUX = ("-Wl,--build-id=none", "-Wl,-z,defs", "-Wl,-Bsymbolic", "-lm")
"""Calls within a library stay in it, whatever else a host has loaded."""

TARGETS = {
    "x86_64-linux": Target(
        triple="x86_64-linux-gnu.2.17", folder="linux64", suffix=".so", options=_LINUX
    ),
    "aarch64-linux": Target(
        triple="aarch64-linux-gnu.2.17", folder="", suffix=".so", options=_LINUX
    ),
    "x86_64-windows": Target(triple="x86_64-windows-gnu", folder="win64", suffix=".dll"),
    "x86_64-darwin": Target(triple="x86_64-macos.11.0", folder="darwin64", suffix=".dylib"),
    "aarch64-darwin": Target(triple="aarch64-macos.11.0", folder="darwin64", suffix=".dylib"),
}
"""Platforms by the name that FMI 3.0 gives them."""


class CompilationError(RuntimeError):
    """The compiler is missing or refused the sources."""


def source_files(model: str) -> dict[str, bytes]:
    """C files of a model with all headers, those of FMI among them, by name."""
    files = {name: (SOURCES / name).read_bytes() for name in MODELS[model]}
    files |= {path.name: path.read_bytes() for path in SOURCES.glob("*.h")}
    return files | {path.name: path.read_bytes() for path in HEADERS.glob("fmi[23]*.h")}


def recipe(model: str, target: str, *, name: str) -> dict[str, bytes]:
    """All that decides on the bytes of `compile_library`, but for the version of ziglang."""
    options = repr((_options(TARGETS[target], name), LANGUAGE, ARITHMETIC, MODELS[model]))
    return source_files(model) | {"options": options.encode()}


def compile_library(model: str, target: str, *, name: str) -> bytes:
    """Shared library of a model.

    Parameters
    ----------
    model : str
        A key of `model_sources.MODELS`.
    target : str
        A key of `TARGETS`.
    name : str
        Name of the library without its suffix; on macOS it is part of the bytes.

    Raises
    ------
    CompilationError
        If ziglang is not installed or does not compile the sources.
    """
    chosen = TARGETS[target]
    return _compile(model, chosen, _options(chosen, name), name=name)


def compile_program(model: str, target: str, *, main: Path) -> bytes:
    """Program of a C file with a function `main` and a model, for tests and benchmarks.

    Parameters
    ----------
    model, target
        As for `compile_library`.
    main : Path
        The C file.

    Raises
    ------
    CompilationError
        If ziglang is not installed or does not compile the sources.
    """
    chosen = TARGETS[target]
    options = ["-target", chosen.triple, "-I.", str(main.resolve()), "-lm"]
    return _compile(model, chosen, options, name="program")


def _compile(model: str, target: Target, options: Sequence[str], *, name: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder) / f"{name}{target.suffix}"
        _run(
            [
                "-o",
                str(result),
                *LANGUAGE,
                "-isystem",
                str(HEADERS),
                *ARITHMETIC,
                *MODELS[model],
                *options,
            ]
        )
        return result.read_bytes()


def _options(target: Target, name: str) -> list[str]:
    """Options that make a shared library."""
    return [
        *("-target", target.triple, "-shared"),
        *(*REPRODUCIBLE, *target.options, *_install_name(target, name)),
    ]


def _install_name(target: Target, name: str) -> list[str]:
    """Name under which a macOS library is known, which is its path if nothing is said."""
    known = f"-Wl,-install_name,@rpath/{name}{target.suffix}"
    return [known] if target.suffix == ".dylib" else []


def this_target() -> str:
    """Key of `TARGETS` of the machine that this runs on.

    Raises
    ------
    CompilationError
        If there is none.
    """
    machine = {"AMD64": "x86_64", "arm64": "aarch64"}.get(platform.machine(), platform.machine())
    system = {"win32": "windows", "darwin": "darwin"}.get(sys.platform, "linux")
    target = f"{machine}-{system}"
    if target not in TARGETS:
        raise CompilationError(
            f"there is no native model for {target}; it must be one of {', '.join(TARGETS)}"
        )
    return target


def _run(arguments: Sequence[str]) -> None:
    """Run the C compiler in the folder of the sources, so that it sees no path."""
    if find_spec("ziglang") is None:
        raise CompilationError(
            "the C compiler is missing: install the package 'ziglang' "
            "(pip install 'railcosim[native]')"
        )
    command = [sys.executable, "-m", "ziglang", "cc", *arguments]
    try:
        subprocess.run(  # noqa: S603 - the arguments are this module's own
            command, cwd=SOURCES, check=True, capture_output=True, text=True, timeout=TIME_LIMIT
        )
    except subprocess.CalledProcessError as error:
        reason = error.stderr.strip() or f"exit code {error.returncode}"
        raise CompilationError(
            f"the C compiler refused the sources in {SOURCES}: {reason}"
        ) from error
    except subprocess.TimeoutExpired as error:
        raise CompilationError(
            f"the C compiler did not answer in {TIME_LIMIT:g} s; free the machine and try again"
        ) from error
