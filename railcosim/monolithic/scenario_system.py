"""The system of a scenario, and the state it starts from."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from fmu_src.python.basis_cache import cached_basis
from track_fmu.assembly import assemble
from track_fmu.modal import compute_basis
from track_fmu.reduction import reduce_track

from ..errors import InputError
from ..track_data import track_parameters
from .full_track import FullTrack, port_incidence
from .laws import HertzLaw
from .modal_track import ModalTrack
from .rail_places import RailPlaces
from .scenario_vehicle import vehicle_of
from .standing import stand
from .static_start import static_start
from .support_laws import support_laws
from .system import CoupledSystem

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from track_fmu.assembly import TrackMatrices

    from ..scenario import Scenario
    from ..track_section import Track
    from .course import Course
    from .held_track import HeldTrack
    from .support_laws import SupportLaws
    from .system import ContactForm

Model: TypeAlias = Literal["modal", "full"]
"""Coordinates of the track: retained modes with residual flexibility, or all nodes."""


def make_system(
    scenario: Scenario,
    held: HeldTrack,
    course: Course,
    *,
    model: Model,
    contact_form: ContactForm,
) -> tuple[CoupledSystem, NDArray[np.float64]]:
    """Return the system of a scenario and its state at t = 0.

    The track starts in the static equilibrium of its full model, moving along, with relaxed pads
    and, as in the FMUs, with nominal dampers: sleepers that hang free are long in forgetting those.
    The vehicle starts in its own equilibrium on that; see `stand`.

    Parameters
    ----------
    scenario : Scenario
        What passes,
    held : HeldTrack
        over which track,
    course : Course
        and on which way.
    model, contact_form
        See `solve`.

    Raises
    ------
    InputError
        For a table that cannot be used, or ballast that moves along in a way that the model does
        not hold.
    RunError
        If track or vehicle find no static equilibrium.
    """
    parameters = track_parameters(held.keys)
    laws = support_laws(
        scenario, held.keys, all_in_matrices=model == "full", first_bay=held.first_bay
    ).with_masses_in_matrices()
    _check_masses(held.keys, laws, model)
    nominal = assemble(parameters)
    matrices = laws.base.put_into(nominal, laws.supports.nominal)
    full = FullTrack(parameters, matrices, pad_ports=laws.pads_have_ports)
    places = RailPlaces(
        course=course,
        parameters=parameters,
        begin=held.begin,
        elements=np.zeros(len(course.starts), dtype=np.intp),
    ).moved_to(0.5 * min([*course.kinks.tolist(), course.stop_time]))
    load = scenario.vehicle.static_wheel_load
    shapes, slopes = (
        full.wheels(places.elements, weights).output[:, : matrices.numbering.size]
        for weights in (places.shapes(0.0), places.slopes(0.0))
    )
    contact = HertzLaw(coefficient=scenario.vehicle.hertz_coefficient)
    vehicle = vehicle_of(scenario)
    at_supports = support_laws(scenario, held.keys, all_in_matrices=False, first_bay=held.first_bay)

    def deflected(loads: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        rate = course.speed(0.0) * (loads @ slopes)
        return static_start(nominal, at_supports, load=loads @ shapes, load_rate=rate)

    standing = stand(
        vehicle, contact, course, load=load, sag=lambda loads: shapes @ deflected(loads)[0]
    )
    system = CoupledSystem(
        track=full if model == "full" else _modal(held.keys, matrices, laws),
        vehicle=vehicle,
        places=places,
        contact=contact,
        laws=laws,
        form=contact_form,
        static_load=load,
        rest=standing.rest,
    )
    displacement, velocity = deflected(standing.loads)
    ports = port_incidence(matrices, pad_ports=laws.pads_have_ports)
    memory = laws.relaxed(ports.T @ displacement)
    own = system.track.begin(displacement, velocity)
    return system, system.begin(own, standing.place, standing.rate, memory)


def _check_masses(track: Track, laws: SupportLaws, model: Model) -> None:
    """Refuse ballast that moves along where the equations do not hold it."""
    if track.ballast_mass == 0.0:
        return
    if model == "modal" and (laws.moving.varies or track.sleeper == "beam"):
        what = "grows" if laws.moving.varies else "lies under sleepers that bend"
        raise InputError(
            f"track.ballast_mass is {track.ballast_mass:g} kg and {what}, which the modal "
            "monolithic solution does not hold: use the full one (--model full)"
        )


def _modal(track: Track, matrices: TrackMatrices, laws: SupportLaws) -> ModalTrack:
    """Return the track in its retained modes, those of the sleepers' own masses."""
    parameters, pairs = track_parameters(track), track.retained_pairs
    if laws.base.mass.any():
        basis = compute_basis(matrices, mode_pairs=pairs)
    else:
        basis = cached_basis(parameters, matrices, mode_pairs=pairs)
    reduced = reduce_track(
        parameters, matrices, basis, residual_flexibility=track.residual_flexibility
    )
    return ModalTrack(reduced, matrices, basis, pad_ports=laws.pads_have_ports)
