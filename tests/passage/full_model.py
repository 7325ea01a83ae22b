"""The passage by an independent formulation: the whole finite element track, no modes, no FMUs.

Newmark's average acceleration rule with a fixed step; contact and ballast forces at the end of each
step are found together by Newton's iteration. Only the element matrices are shared with the package
(`tests/track` checks those by themselves). Under sleepers that bend, the ballast increment follows
the mean deflection, as in the package, or the deflection of every point of the sleeper by itself.
"""

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from scipy.linalg import cho_solve_banded, cholesky_banded

from track_fmu.assembly import assemble, to_banded
from track_fmu.beam_element import deflection_shape, shear_parameter
from track_fmu.contact_point import locate
from track_fmu.parameters import TrackParameters
from track_fmu.sleeper import sleeper_nodes

HERTZ = 9.17e10
MASS = 592.5
LOAD = 117_720.0
ALPHA, BETA, DELTA, TAU = 0.37e12, -2.47e15, 5.75e18, 31e3 / 30e6


def haversine(distance, length=0.1, depth=0.9e-3):
    a = abs(distance) / (0.5 * length)
    return 0.5 * depth * (1.0 + np.cos(np.pi * a)) if a < 1.0 else 0.0


def varied(parameters, pads, beds):
    """Matrices of a track with factors on its pads and ballast beds."""
    matrices = assemble(parameters)
    pad, bed = (
        part @ sp.diags_array(factors) @ part.T
        for part, factors in (
            (matrices.pad_incidence, pads - 1.0),
            (matrices.ballast_incidence, beds - 1.0),
        )
    )
    return replace(
        matrices,
        stiffness=sp.csc_array(
            matrices.stiffness + parameters.pad_stiffness * pad + parameters.ballast_stiffness * bed
        ),
        damping=sp.csc_array(
            matrices.damping + parameters.pad_damping * pad + parameters.ballast_damping * bed
        ),
    )


@dataclass
class Passage:
    position: np.ndarray
    force: np.ndarray
    sleeper: np.ndarray
    second_force: np.ndarray


def local_beds(parameters, numbering):
    """Deflections at the Gauss points under all sleepers, shape (N, points), and their shares."""
    nodes, _ = sleeper_nodes(
        parameters.sleeper_half_length, parameters.sleeper_rail_seat, parameters.sleeper_elements
    )
    places, weights = np.polynomial.legendre.leggauss(2)
    columns, shares = [], []
    for dofs in numbering.sleeper_dofs:
        padded = np.array([dofs[0], -1, *dofs[1:]])
        for element, length in enumerate(np.diff(nodes)):
            phi = shear_parameter(parameters.sleeper_section, length)
            for place, weight in zip(places, weights, strict=True):
                column = np.zeros(numbering.size + 1)
                shape = deflection_shape(0.5 * (1.0 + place), length, phi)
                column[padded[2 * element : 2 * element + 4]] = shape
                columns.append(column[:-1])
                shares.append(0.5 * weight * length / nodes[-1])
    return np.array(columns).T, np.array(shares)


class FullModel:
    """The track; pads and ballast beds may have factors, and sleepers gaps under them.

    Factors are in the matrices. Under a gap there is no linear ballast: all of its force is in the
    law then.
    """

    def __init__(
        self, *, state_dependent=True, local=False, pads=None, beds=None, gaps=None, **values
    ):
        self.parameters = TrackParameters(**values)
        ones = np.ones(self.parameters.supports)
        self.factors = 1.0 if beds is None else beds
        self.gaps = np.zeros(1) if gaps is None else gaps
        linear_beds = np.where(self.gaps > 0.0, 0.0, self.factors) * ones
        self.matrices = varied(self.parameters, ones if pads is None else pads, linear_beds)
        self.scale = 1.0 if state_dependent else 0.0
        self.sleeper = self.matrices.numbering.sleeper
        self.size = self.matrices.mass.shape[0]
        self.beds, self.share = self.matrices.ballast_incidence.toarray(), 1.0
        if local:
            self.beds, self.share = local_beds(self.parameters, self.matrices.numbering)

    def contact_columns(self, positions):
        columns = np.zeros((self.size + 1, len(positions)))
        for i, position in enumerate(positions):
            point = locate(self.parameters, float(position))
            dofs = self.matrices.numbering.rail[point.element : point.element + 2].ravel()
            columns[dofs, i] += point.shape
        return columns[:-1]

    def ballast(self, x, v):
        """Increment and its derivatives by displacement and velocity."""
        hangs = self.gaps > 0.0
        x = self.scale * np.maximum(x - self.gaps, 0.0)
        secant = x * (ALPHA + x * (BETA + x * DELTA)) + np.where(hangs, 30e6, 0.0)
        slope = ALPHA + x * (2 * BETA + x * 3 * DELTA)
        onset = np.where(hangs, np.minimum(x / 20e-6, 1.0), 1.0)
        onset_slope = np.where(hangs & (x > 0.0) & (x < 20e-6), 1.0 / 20e-6, 0.0)
        force = secant * (x + onset * TAU * v)
        by_x = secant * (1.0 + onset_slope * TAU * v) + slope * (x + onset * TAU * v)
        gone = hangs & ((x <= 0.0) | (force < 0.0))
        values = (force, by_x, onset * TAU * secant)
        return tuple(self.share * self.factors * np.where(gone, 0.0, value) for value in values)

    def equilibrium(self, positions):
        columns = self.contact_columns(positions)
        factor = cholesky_banded(to_banded(self.matrices.stiffness), lower=True)
        flexibility = cho_solve_banded((factor, True), self.beds)
        linear = cho_solve_banded((factor, True), columns @ np.full(len(positions), LOAD))
        force = np.zeros(self.beds.shape[1])
        among = self.beds.T @ flexibility
        for _ in range(60):
            x = linear - flexibility @ force
            value, slope, _ = self.ballast(self.beds.T @ x, 0.0)
            jacobian = np.eye(len(force)) + slope[:, None] * among
            force = force + np.linalg.solve(jacobian, value - force)
        return linear - flexibility @ force

    def run(
        self,
        *,
        speed,
        drop,
        second_drop=lambda _: 0.0,
        start=12.7,
        stop=19.2,
        axle_base=1.8,
        step=2e-5,
    ):
        mass, damping, stiffness = (
            self.matrices.mass,
            self.matrices.damping,
            self.matrices.stiffness,
        )
        effective = stiffness + (2.0 / step) * damping + (4.0 / step**2) * mass
        factor = cholesky_banded(to_banded(effective), lower=True)
        response = cho_solve_banded((factor, True), self.beds)
        among = self.beds.T @ response
        offsets = np.array([0.0, -axle_base])
        x, v = self.equilibrium(start + offsets), np.zeros(self.size)
        a = np.zeros(self.size)
        z = self.contact_columns(start + offsets).T @ x + (LOAD / HERTZ) ** (2 / 3)
        z += [drop(start), second_drop(start - axle_base)]
        zv, za = np.zeros(2), np.zeros(2)
        for i, (profile, at) in enumerate([(drop, start), (second_drop, start - axle_base)]):
            zv[i] = speed * (profile(at + 1e-6) - profile(at - 1e-6)) / 2e-6
        force, increment = np.full(2, LOAD), self.ballast(self.beds.T @ x, 0.0)[0]
        wheel_response = step**2 / (4.0 * MASS)
        history = []
        for k in range(1, round((stop - start) / speed / step) + 1):
            at = start + offsets + speed * step * k
            columns = self.contact_columns(at)
            columns_response = cho_solve_banded((factor, True), columns)
            predicted = 4.0 / step**2 * x + 4.0 / step * v + a
            right = mass @ predicted + damping @ (2.0 / step * x + v)
            free = cho_solve_banded((factor, True), right)
            free_wheel = z + step * zv + step**2 / 4.0 * za + wheel_response * LOAD
            surface = np.array([drop(at[0]), second_drop(at[1])])
            for _ in range(30):
                new = free + columns_response @ force - response @ increment
                new_v = 2.0 / step * (new - x) - v
                compression = free_wheel - wheel_response * force - columns.T @ new - surface
                pressed = np.maximum(compression, 0.0)
                ballast, by_x, by_v = self.ballast(self.beds.T @ new, self.beds.T @ new_v)
                by_x = by_x + 2.0 / step * by_v
                residual = np.concatenate(
                    [HERTZ * pressed**1.5 - force, self.scale * (ballast - increment)]
                )
                if np.abs(residual).max() < 1e-6:
                    break
                contact = 1.5 * HERTZ * np.sqrt(pressed)
                jacobian = np.eye(2 + len(among))
                jacobian[:2, :2] += contact[:, None] * (
                    columns.T @ columns_response + wheel_response * np.eye(2)
                )
                jacobian[:2, 2:] -= contact[:, None] * (columns.T @ response)
                jacobian[2:, :2] -= by_x[:, None] * (self.beds.T @ columns_response)
                jacobian[2:, 2:] += by_x[:, None] * among
                change = np.linalg.solve(jacobian, residual)
                force, increment = force + change[:2], increment + change[2:]
            else:
                raise RuntimeError(f"no convergence at step {k}")
            x, v, a = new, new_v, 4.0 / step**2 * (new - x) - 4.0 / step * v - a
            za_new = (LOAD - force) / MASS
            z, zv = free_wheel - wheel_response * force, zv + 0.5 * step * (za + za_new)
            za = za_new
            history.append((at[0], force[0], x[self.sleeper].max(), force[1]))
        columns = np.array(history).T
        return Passage(*columns)
