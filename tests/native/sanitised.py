"""Compiles the fuzzer in `fuzz` with a model under sanitizers."""

import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from fmu_src.native.compiler import ARITHMETIC, HEADERS, LANGUAGE, SOURCES
from fmu_src.native.model_sources import MODELS

FUZZER = Path(__file__).with_name("fuzz")
READERS_FUZZER = (
    *(FUZZER / name for name in ("draw.c", "tables.c")),
    FUZZER.parent / "fuzz_tables/main.c",
)
READERS = ("support_file.c", "support_line.c", "table_file.c")
"""Sources of the fuzzer of CSV files, and of the models' readers of them."""
CHECKS = {
    "gcc": "-fsanitize=address,undefined,float-cast-overflow",
    "zig": "-fsanitize=undefined,float-cast-overflow",  # ziglang brings no run time for the other
}
ENVIRONMENT = {
    "ASAN_OPTIONS": "allocator_may_return_null=1:max_allocation_size_mb=2000",
    "UBSAN_OPTIONS": "print_stacktrace=1",
}
"""An FMU asks for the result of malloc; the sanitizer shall let it see that there is none."""


def compiler():
    """The better one of those that there are."""
    return "gcc" if shutil.which("gcc") else "zig"


def command(chosen):
    program = [shutil.which("gcc")] if chosen == "gcc" else [sys.executable, "-m", "ziglang", "cc"]
    return [
        *program,
        *(option for option in LANGUAGE if option != "-Werror"),
        *(option for option in ARITHMETIC if not option.startswith("-O")),
        *("-O1", "-g1", CHECKS[chosen], "-fno-sanitize-recover=all", "-fno-omit-frame-pointer"),
    ]


def compile_all(folder, names, chosen):
    """Objects of sources of the models and of the fuzzer, two at a time."""

    def compile_one(source):
        target = folder / f"{source.stem}.o"
        options = ["-isystem", HEADERS, f"-I{SOURCES}", "-c", source, "-o", target]
        run([*command(chosen), *options])
        return target

    sources = [*(SOURCES / name for name in names), *sorted(FUZZER.glob("*.c"))]
    with ThreadPoolExecutor(max_workers=2) as pool:
        objects = list(pool.map(compile_one, sources))
    return {source.name: target for source, target in zip(sources, objects, strict=True)}


def build(folder, models, chosen):
    """Path of the fuzzer of every model."""
    objects = compile_all(folder, {name for model in models for name in MODELS[model]}, chosen)
    programs = {}
    for model in models:
        programs[model] = folder / f"fuzz-{model}"
        chosen_objects = [objects[name] for name in MODELS[model]]
        chosen_objects += [objects[path.name] for path in FUZZER.glob("*.c")]
        run([*command(chosen), *chosen_objects, "-lm", "-o", programs[model]])
    return programs


def build_readers(folder, chosen):
    """Path of the fuzzer of CSV files."""
    sources = [*READERS_FUZZER, *(SOURCES / name for name in READERS)]
    program, include = folder / "fuzz-tables", [f"-I{SOURCES}", f"-I{FUZZER}"]
    run([*command(chosen), *include, *sources, "-lm", "-o", program])
    return program


def run(arguments):
    done = subprocess.run(arguments, check=False, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr


def fuzz(program, *arguments, timeout):
    """What the fuzzer counted; its complaint is an error."""
    done = subprocess.run(
        [program, *map(str, arguments)],
        check=False,
        capture_output=True,
        text=True,
        errors="replace",
        timeout=timeout,
        env=os.environ | ENVIRONMENT,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()
