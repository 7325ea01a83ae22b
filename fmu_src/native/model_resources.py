"""Resources of the native models: the numpy model's basis and the start values of the variables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict

import numpy as np
from numpy.typing import NDArray

from fmu_src.python.basis_cache import cached_basis
from fmu_src.python.masses_variables import declare_masses
from fmu_src.python.model_slave import LINEAR_INPUTS
from fmu_src.python.track_contact_variables import declare_track_contact
from fmu_src.python.track_parameters import SLEEPER, TABLE_1
from fmu_src.python.track_variables import declare_track
from fmu_src.python.variables import Variable
from fmu_src.python.vehicle_variables import declare_vehicle
from track_fmu.assembly import assemble
from track_fmu.beam_element import FloatArray, mass_matrix, shear_parameter
from track_fmu.eigensolver import ComplexArray
from track_fmu.parameters import TrackParameters
from track_fmu.reduction import ReducedTrack, reduce_track
from track_fmu.sleeper import half_sleeper

from .resource import Section, pack, start_values

LANES = 8  # RC_LANES of c/rows.h


def track_resource(
    parameters: TrackParameters,
    *,
    wheels: int,
    gauges: int,
    mode_pairs: int,
    residual_flexibility: bool = True,
    contact: bool = False,
) -> bytes:
    """Resource of a track, whose modes are computed or taken from the cache.

    Parameters
    ----------
    parameters : TrackParameters
        The linear track; fixed in the FMU.
    wheels, gauges : int
        Number of wheels and of bending moment gauges.
    mode_pairs : int
        Retained pairs of modes; fixed in the FMU.
    residual_flexibility : bool
        Whether the quasi-static part of the other modes is accounted for; fixed in the FMU.
    contact : bool
        Whether the track finds its contact forces itself.
    """
    matrices = assemble(parameters)
    basis = cached_basis(parameters, matrices, mode_pairs=mode_pairs)
    reduced = reduce_track(parameters, matrices, basis, residual_flexibility=residual_flexibility)
    declare = declare_track_contact if contact else _declare_track
    variables = declare(parameters, wheels=wheels, gauges=gauges)
    fixed = {name: asdict(parameters)[name] for name, _, _ in (*TABLE_1, *SLEEPER)}
    fixed |= {"mode_pairs": mode_pairs, "residual_flexibility": residual_flexibility}
    half, sleeper = _filled(len(reduced.eigenvalues)), half_sleeper(parameters)
    sections: dict[str, Section] = {
        "model": b"TrackContact" if contact else b"Track",
        "structure": np.array(
            [
                *(wheels, gauges, parameters.bays, parameters.elements_per_bay),
                *(len(reduced.eigenvalues), half),
                *(sleeper.size, sleeper.seat),
            ],
            dtype=np.int64,
        ),
        "numbers": _numbers(parameters),
        "inertia": mass_matrix(parameters.section, parameters.element_length),
        "sleeper_mass": sleeper.mass,
        "sleeper_bed": sleeper.bed,
    }
    return pack(sections | _modes(reduced, half) | start_values(variables, fixed))


def vehicle_resource(*, wheels: int, bogies: int = 1) -> bytes:
    """Resource of a vehicle; all of its parameters stay parameters of the FMU."""
    variables = [*declare_vehicle(wheels, bogies=bogies), LINEAR_INPUTS]
    return _wheels_resource(b"Vehicle", (wheels, bogies), variables)


def masses_resource(*, wheels: int, bogies: int = 1) -> bytes:
    """Resource of wheel masses; all of their parameters stay parameters of the FMU."""
    return _wheels_resource(b"Masses", (wheels, bogies), declare_masses(wheels, bogies=bogies))


def _declare_track(structure: TrackParameters, *, wheels: int, gauges: int) -> list[Variable]:
    return [*declare_track(structure, wheels=wheels, gauges=gauges), LINEAR_INPUTS]


def _wheels_resource(model: bytes, size: tuple[int, int], variables: Sequence[Variable]) -> bytes:
    """Resource of a model of which nothing is fixed but the numbers of wheels and bogies."""
    sections: dict[str, Section] = {
        "model": model,
        "structure": np.array(size, dtype=np.int64),
    }
    return pack(sections | start_values(variables, {}))


def _numbers(parameters: TrackParameters) -> FloatArray:
    return np.array(
        [
            parameters.sleeper_spacing,
            shear_parameter(parameters.section, parameters.element_length),
            parameters.pad_stiffness,
            parameters.pad_damping,
            parameters.ballast_stiffness,
            parameters.ballast_damping,
        ]
    )


def _modes(reduced: ReducedTrack, half: int) -> dict[str, Section]:
    """The reduced track, rows of modes split and filled up."""
    weight = np.zeros(half)
    weight[: len(reduced.weight)] = reduced.weight
    sleepers: dict[str, Section] = {
        "sleeper_shape": _rows(reduced.sleeper_shape, half),
        "sleeper_flexibility": reduced.sleeper_flexibility,
        "bent_shape": _rows(reduced.bent_shape, half),
        "bent_flexibility": np.ascontiguousarray(reduced.bent_flexibility.T),
    }
    return (sleepers if len(reduced.sleeper_shape) else {}) | {
        "eigenvalues": _rows(reduced.eigenvalues, half),
        "inverses": _rows(1.0 / reduced.eigenvalues, half),
        "weight": weight,
        "shape": _rows(reduced.shape, half),
        "moment_shape": _rows(reduced.moment_shape, half),
        "flexibility": reduced.flexibility,
        "moment_flexibility": reduced.moment_flexibility,
    }


def _rows(values: ComplexArray, half: int) -> NDArray[np.float64]:
    """Real parts, then imaginary parts, each filled with zeros; shape (..., 2 half)."""
    modes = values.shape[-1]
    rows = np.zeros((*values.shape[:-1], 2 * half))
    rows[..., :modes] = values.real
    rows[..., half : half + modes] = values.imag
    return rows


def _filled(modes: int) -> int:
    return -(-modes // LANES) * LANES
