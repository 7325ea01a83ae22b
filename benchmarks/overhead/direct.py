"""The two FMUs stepped by a few lines of Python and fmpy alone."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from ctypes import byref, c_double, c_uint, c_void_p
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any, NamedTuple

import fmpy
from fmpy.fmi2 import FMU2Slave
from overhead.system import PARTNERS, STEP, Sample


@contextmanager
def slaves(fmu: Path) -> Iterator[tuple[list[FMU2Slave], int, int]]:
    """Initialise both instances; yield them and the references of u and y."""
    description = fmpy.read_model_description(str(fmu))
    references = {item.name: item.valueReference for item in description.modelVariables}
    with TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        fmpy.extract(str(fmu), folder)
        both = []
        for name, parameters in PARTNERS.items():
            slave = FMU2Slave(
                guid=description.guid,
                unzipDirectory=folder,
                modelIdentifier=description.coSimulation.modelIdentifier,
                instanceName=name,
            )
            slave.instantiate()
            slave.setReal([references[key] for key in parameters], list(parameters.values()))
            slave.setupExperiment()
            slave.enterInitializationMode()
            slave.exitInitializationMode()
            both.append(slave)
        try:
            yield both, references["u"], references["y"]
        finally:
            for slave in both:
                slave.terminate()
                slave.freeInstance()


def wrapper_classes(fmu: Path, steps: int) -> Sample:
    """Jacobi through the methods of fmpy's FMU2Slave."""
    with slaves(fmu) as ((left, right), u, y):
        y_left, y_right = left.getReal([y]), right.getReal([y])
        began = perf_counter()
        for n in range(steps):
            left.setReal([u], y_right)
            right.setReal([u], y_left)
            left.doStep(n * STEP, STEP)
            right.doStep(n * STEP, STEP)
            y_left, y_right = left.getReal([y]), right.getReal([y])
        seconds = perf_counter() - began
    return Sample(microseconds=1e6 * seconds / steps, final=(y_left[0], y_right[0]))


class Raw(NamedTuple):
    """Raw functions of an instance, and arguments for them that were allocated once."""

    component: c_void_p
    set: Callable[..., int]
    step: Callable[..., int]
    get: Callable[..., int]
    save: Callable[..., int]
    restore: Callable[..., int]
    release: Callable[..., int]
    u: Any
    y: Any
    inputs: Any
    outputs: Any


def _raw(slave: FMU2Slave, u: int, y: int) -> Raw:
    names = ("SetReal", "DoStep", "GetReal", "GetFMUstate", "SetFMUstate", "FreeFMUstate")
    functions = (slave._functions[f"fmi2{name}"] for name in names)  # noqa: SLF001 - unwrapped calls
    raw = Raw(
        c_void_p(slave.component),
        *functions,
        (c_uint * 1)(u),
        (c_uint * 1)(y),
        (c_double * 1)(),
        (c_double * 1)(),
    )
    raw.get(raw.component, raw.y, 1, raw.outputs)
    return raw


def raw_calls(fmu: Path, steps: int) -> Sample:
    """Jacobi with fmpy's raw functions: the least that ctypes as it is usually used allows."""
    with slaves(fmu) as ((left, right), u, y):
        a, set_a, step_a, get_a, *_, u_a, y_a, in_a, out_a = _raw(left, u, y)
        b, set_b, step_b, get_b, *_, u_b, y_b, in_b, out_b = _raw(right, u, y)
        began = perf_counter()
        for n in range(steps):
            time = n * STEP
            in_a[0], in_b[0] = out_b[0], out_a[0]
            set_a(a, u_a, 1, in_a)
            step_a(a, time, STEP, 0)
            get_a(a, y_a, 1, out_a)
            set_b(b, u_b, 1, in_b)
            step_b(b, time, STEP, 0)
            get_b(b, y_b, 1, out_b)
        seconds = perf_counter() - began
        final = (out_a[0], out_b[0])
    return Sample(microseconds=1e6 * seconds / steps, final=final)


def raw_iterated_calls(fmu: Path, steps: int) -> Sample:
    """The calls of an implicit step: save, step both, go back, step both again, release."""
    with slaves(fmu) as (both, u, y):
        raws = [_raw(slave, u, y) for slave in both]
        states = [c_void_p() for _ in raws]
        began = perf_counter()
        for n in range(steps):
            for raw, state in zip(raws, states, strict=True):
                raw.save(raw.component, byref(state))
            for again in (False, True):
                for raw, state in zip(raws, states, strict=True):
                    if again:
                        raw.restore(raw.component, state)
                    raw.set(raw.component, raw.u, 1, raw.inputs)
                    raw.step(raw.component, n * STEP, STEP, 0)
                    raw.get(raw.component, raw.y, 1, raw.outputs)
            for raw, state in zip(raws, states, strict=True):
                raw.release(raw.component, byref(state))
        seconds = perf_counter() - began
    return Sample(microseconds=1e6 * seconds / steps, iterations=2.0)
