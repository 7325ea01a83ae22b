"""The derivative of the coupled system by its state, which implicit integrators ask for."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from .bed_inertia import bed_parts
from .blocks import DENSE, SPARSE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from .blocks import Blocks
    from .linear_track import Matrix
    from .system import CoupledSystem, Instant


def jacobian(system: CoupledSystem, time: float, state: NDArray[np.float64]) -> Matrix:
    """Return the derivative of ``mass y'`` by the state, sparse where the track's matrix is.

    Parameters
    ----------
    system : CoupledSystem
        Of n components of state.
    time : float
        [s].
    state : ndarray, shape (n,)
        At that time.

    Returns
    -------
    Matrix, shape (n, n)
        Exact but at the kinks of the laws.
    """
    now, track, vehicle, w = (
        system.instant(time, state),
        system.track,
        system.vehicle,
        system.wheels,
    )
    blocks = SPARSE if sp.issparse(track.matrix) else DENSE
    _, rate, inputs = (blocks.matrix(part) for part in now.wheels)
    memory = state[system.parts[-1]]
    forces = _of_forces(system, now, memory, blocks)
    on_wheels = forces[:w]
    by_place, by_rate = vehicle.tangent(state[system.parts[1]], state[system.parts[2]])
    rows = [
        _padded(system, track.matrix, blocks)
        + inputs.T @ on_wheels
        + track.supports.inputs.T @ forces[w:],
        _columns(system, {2: np.eye(len(by_rate))}, blocks),
        _columns(system, {1: by_place, 2: by_rate}, blocks)
        - blocks.matrix(vehicle.mobility) @ on_wheels,
    ]
    if system.form == "constraint":
        along = _padded(system, rate + blocks.matrix(system.convective(time)), blocks)
        if now.feedthrough is not None:
            along = along + now.feedthrough.mobility[:w] @ forces
        rows += [along, on_wheels]
    if len(memory):
        rows.append(_of_memories(system, now, memory, forces, blocks))
    return blocks.stack(rows)


def _of_forces(
    system: CoupledSystem, now: Instant, memory: NDArray[np.float64], blocks: Blocks
) -> Matrix:
    """Derivative of all port forces by the state, shape (p, n)."""
    w, track = system.wheels, system.track
    tied = system.form == "constraint"
    wheels = -np.eye(w, len(system.vehicle.scale))
    compression = _columns(system, {1: wheels} | ({3: np.eye(w)} if tied else {}), blocks)
    if not tied:
        compression = compression + _padded(system, blocks.matrix(now.wheels.output), blocks)
    displacement = blocks.stack([compression, _padded(system, track.supports.output, blocks)])
    still = blocks.zeros(w, system.size)
    rate = blocks.stack([still, _padded(system, track.supports.rate, blocks)])
    forces: Matrix = sp.diags_array(now.forces.by_displacement) @ displacement
    forces = forces + sp.diags_array(now.forces.by_rate) @ rate
    if len(memory):
        by_memory = -system.laws.by_memory(now.displacement[w:], memory)
        forces = forces + _remembered(system, np.append(np.zeros(w), by_memory), blocks)
    if now.forces.by_acceleration is not None:
        forces = _with_inertia(system, now.forces.by_acceleration, forces, blocks)
    if now.feedthrough is None:
        return forces
    return np.linalg.solve(now.forces.sensitivity(now.feedthrough), forces)


def _with_inertia(
    system: CoupledSystem, by_acceleration: NDArray[np.float64], forces: Matrix, blocks: Blocks
) -> Matrix:
    """Add what beds answer to accelerations, to which their own forces contribute, (p, n)."""
    beds, (above, under, behind) = system.track.beds, bed_parts(system.laws, forces.shape[0])
    assert beds is not None  # or nothing depends on accelerations
    mass = by_acceleration[under]
    free = _padded(system, beds.of_state, blocks)
    if system.laws.pads_have_ports:
        free = free + sp.diags_array(beds.of_pad) @ forces[behind]
    borne = sp.diags_array(1.0 / (1.0 - mass * beds.of_bed)) @ (
        forces[under] + sp.diags_array(mass) @ free
    )
    return blocks.stack([forces[above], borne, forces[behind]])


def _of_memories(
    system: CoupledSystem,
    now: Instant,
    memory: NDArray[np.float64],
    forces: Matrix,
    blocks: Blocks,
) -> Matrix:
    """Derivative of the rates of the memories by the state, shape (memories, n)."""
    change = system.laws.relaxation(now.displacement[system.wheels :], memory)
    deformation = _padded(system, system.track.supports.output, blocks)
    if now.feedthrough is not None:
        deformation = deformation + now.feedthrough.flexibility[system.wheels :] @ forces
    of_pads = deformation[deformation.shape[0] - len(memory) :]
    by_displacement = sp.diags_array(change.by_displacement) @ of_pads
    return by_displacement + _remembered(system, change.by_memory, blocks)


def _remembered(system: CoupledSystem, values: NDArray[np.float64], blocks: Blocks) -> Matrix:
    """Rows with the last values, one a memory, in the columns of the memories."""
    rows, count = np.zeros((len(values), system.size)), system.laws.memories
    np.fill_diagonal(rows[-count:, system.parts[-1]], values[-count:])
    return blocks.matrix(rows)


def _padded(system: CoupledSystem, rows: Matrix, blocks: Blocks) -> Matrix:
    """Rows that see the track alone, as rows that see the whole state."""
    return blocks.beside([rows, blocks.zeros(rows.shape[0], system.size - rows.shape[1])])


def _columns(
    system: CoupledSystem, given: Mapping[int, NDArray[np.float64]], blocks: Blocks
) -> Matrix:
    """Rows of given blocks in the columns of given parts of the state."""
    rows = np.zeros((len(next(iter(given.values()))), system.size))
    for part, block in given.items():
        rows[:, system.parts[part]] = block
    return blocks.matrix(rows)
