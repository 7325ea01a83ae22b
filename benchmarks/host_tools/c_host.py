"""A plain host in C, with no Python in its process: compiled here, told its job in a text file."""

import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

import fmpy

from fmu_src.native.compiler import HEADERS, TARGETS, this_target

from .answer import Answer, HostError, run_process
from .scripts.job import Job

SOURCES = Path(__file__).with_name("c")
WARNINGS = ("-Wall", "-Wextra", "-Wconversion", "-Wpedantic", "-Wshadow", "-Werror")


def compile_host(folder: Path, target: str | None = None) -> Path:
    """Compile the host into a folder, with the ziglang wheel, and return the program.

    Parameters
    ----------
    folder : Path
        Where it is written.
    target : str, optional
        A key of `fmu_src.native.compiler.TARGETS`; this machine without.

    Raises
    ------
    HostError
        If it cannot be compiled.
    """
    target = target or this_target()
    program = folder / ("host.exe" if target.endswith("windows") else "host")
    command = [sys.executable, "-m", "ziglang", "cc", "-std=c11", "-O2", *WARNINGS]
    command += ["-target", TARGETS[target].triple, "-isystem", str(HEADERS)]
    command += [*(str(path) for path in sorted(SOURCES.glob("*.c"))), "-o", str(program)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise HostError(f"failed: the C compiler says {done.stderr.strip()}")
    return program


@dataclass(frozen=True, kw_only=True)
class CHost:
    """The compiled host.

    Parameters
    ----------
    program : Path
        As `compile_host` wrote it.
    target : str
        What it was compiled for.
    launcher : tuple of str
        What starts it, if it cannot start by itself.
    environment : mapping of str to str, optional
        Environment variables; the present ones without.
    """

    program: Path
    target: str = field(default_factory=this_target)
    launcher: tuple[str, ...] = ()
    environment: Mapping[str, str] | None = None

    def run(self, job: Job) -> Answer:
        """Run a job; the version of FMI is that of its FMUs.

        Raises
        ------
        HostError
            When it fails.
        """
        with self._told(job) as path:
            command = [*self.launcher, str(self.program), self._native(path)]
            return Answer.of(run_process(command, self.environment))

    @contextmanager
    def _told(self, job: Job) -> Iterator[Path]:
        """Unpack the FMUs and write the text file."""
        with TemporaryDirectory() as folder:
            place = {name: k for k, name in enumerate(job.fmus)}
            lines = []
            references = {}
            for name, fmu in job.fmus.items():
                root = Path(folder) / name
                fmpy.extract(fmu, str(root))
                description = fmpy.read_model_description(fmu)
                version = int(description.fmiVersion[0])
                for variable in description.modelVariables:
                    reference = f"{place[name]} {variable.valueReference}"
                    references[name, variable.name] = reference
                lines += [f"slave {name}", *self._archive(description, root, version)]
            lines = [f"fmi {version}", f"steps {job.step_size!r} {job.steps}", *lines]
            for name, values in job.parameters.items():
                lines += [
                    f"parameter {references[name, key]} {value!r}" for key, value in values.items()
                ]
            lines += [
                f"connection {references[source, output]} {references[target, variable]}"
                for source, output, target, variable in job.connections
            ]
            lines += [f"watched {references[name, output]}" for name, output in job.watched]
            path = Path(folder) / "job.txt"
            path.write_text("\n".join(lines) + "\n", encoding="utf-8")
            yield path

    def _archive(
        self, description: fmpy.model_description.ModelDescription, root: Path, version: int
    ) -> list[str]:
        """Where an unpacked FMU has its library and resources, and its token."""
        target = TARGETS[self.target]
        binaries = root / "binaries" / (target.folder if version == 2 else self.target)
        library = binaries / f"{description.coSimulation.modelIdentifier}{target.suffix}"
        if not library.exists():
            raise HostError(f"failed: {description.modelName} is not compiled for {self.target}")
        resources = self._native(root / "resources")
        if version == 2:
            uri = resources.replace("\\", "/")
            resources = f"file://{'' if uri.startswith('/') else '/'}{uri}"
        else:
            resources += "\\" if "windows" in self.target else "/"
        token = description.guid if version == 2 else description.instantiationToken
        return [f"library {self._native(library)}", f"token {token}", f"resources {resources}"]

    def _native(self, path: Path) -> str:
        """A path as the program's system writes it; Wine's Z: is the root of the machine."""
        if "windows" not in self.target or sys.platform == "win32":
            return str(path)
        return "Z:" + str(path).replace("/", "\\")
