"""Receptances of pads, ballast and supports that are not the paper's."""

from pathlib import Path

import numpy as np
import pytest

from railcosim.errors import InputError, RunError
from railcosim.monolithic.full_track import FullTrack, port_incidence
from railcosim.monolithic.static_start import static_start
from railcosim.monolithic.support_laws import support_laws
from railcosim.receptance.points import Place, track_point
from railcosim.receptance.preload import support_tangent
from railcosim.receptance.study import ReceptanceStudy
from railcosim.scenario_file import read_scenario
from railcosim.track_data import track_parameters
from track_fmu.assembly import assemble

EXAMPLES = Path(__file__).parents[2] / "examples"
PAD = f"track.pad={EXAMPLES / 'pad.csv'}"
SMALL = ("track.bays=10", "flat.position=3.6", "run.approach=0.2", "run.departure=0.2")
SOFT = (  # a rail without stiffness and mass leaves one support
    "track.bending_stiffness=1e-3",
    "track.shear_stiffness=1e-3",
    "track.mass_per_length=1e-9",
    "track.rotary_inertia_per_length=0",
)
DIFFERENT = ("variation.ballast_stiffness_deviation=0.4", "variation.pad_stiffness_deviation=0.3")
ABOVE = Place(position=5 * 0.65)
FREQUENCIES = np.array([0.0, 15.9, 64.0, 258.0, 955.0])
OMEGA = 2.0 * np.pi * FREQUENCIES


def study(*overrides, preload=0.0, load=ABOVE):
    scenario = read_scenario(None, (*SMALL, *overrides))
    return ReceptanceStudy(scenario=scenario, load=load, response=load, preload=preload)


def one_support(pad, bed):
    """Receptance of pad, sleeper and ballast in series [m/N]."""
    bed = bed - OMEGA**2 * 125.0
    return 1.0 / pad + 1.0 / bed


def test_a_pad_with_a_branch_is_stiffer_in_motion():
    """``k0 + k1 i w c1 / (k1 + i w c1)`` at the preload of the clip, on linear ballast."""
    pad = 20e6 + 60e6 * 1j * OMEGA * 600e3 / (60e6 + 1j * OMEGA * 600e3)
    expected = one_support(pad, 30e6 + 1j * OMEGA * 31e3)
    found = study(*SOFT, PAD).receptance(FREQUENCIES)
    assert np.abs(found / expected - 1.0).max() < 1e-6


def test_a_pad_under_a_preload_has_the_parameters_there():
    """20 kN of the clip and 20 kN of the load are the row of 40 kN."""
    pad = 33e6 + 99e6 * 1j * OMEGA * 990e3 / (99e6 + 1j * OMEGA * 990e3)
    expected = one_support(pad, 30e6 + 1j * OMEGA * 31e3)
    found = study(*SOFT, PAD, "track.ballast=linear", preload=20e3).receptance(FREQUENCIES)
    assert np.abs(found / expected - 1.0).max() < 1e-5


@pytest.mark.parametrize("tangent", [False, True])
def test_hyperbolic_ballast_under_a_preload(tangent):
    """Secant ``k + s F``, tangent ``(k + s F)^2 / k``, Eq. (26); damping with either."""
    secant = 30e6 + 2e3 * 20e3
    stiffness = secant**2 / 30e6
    damping = 31e3 / 30e6 * (stiffness if tangent else secant)
    expected = one_support(80e6 + 1j * OMEGA * 15e3, stiffness + 1j * OMEGA * damping)
    keys = ("track.ballast=hyperbolic", f"track.ballast_tangent_damping={str(tangent).lower()}")
    found = study(*SOFT, *keys, preload=20e3).receptance(FREQUENCIES)
    assert np.abs(found / expected - 1.0).max() < 1e-6


def test_factors_of_the_support_under_the_force(tmp_path):
    table = tmp_path / "supports.csv"
    table.write_text(
        "number,pad_stiffness_factor,pad_damping_factor,ballast_stiffness_factor,"
        "ballast_damping_factor\n5,0.5,2,3,0.7\n"
    )
    expected = one_support(40e6 + 30e3j * OMEGA, 90e6 + 0.7 * 31e3j * OMEGA)
    found = study(*SOFT, f"track.supports={table}").receptance(FREQUENCIES)
    assert np.abs(found / expected - 1.0).max() < 1e-6


def test_equal_factors_are_another_nominal_track(tmp_path):
    table = tmp_path / "supports.csv"
    rows = "".join(f"{i},2,2\n" for i in range(1, 10))
    table.write_text(f"number,ballast_stiffness_factor,ballast_damping_factor\n{rows}")
    found = study(f"track.supports={table}", "track.ballast=linear").receptance(FREQUENCIES)
    nominal = study(
        "track.ballast=linear", "track.ballast_stiffness=60e6", "track.ballast_damping=62e3"
    )
    assert found == pytest.approx(nominal.receptance(FREQUENCIES), rel=1e-9)


def test_the_mass_of_a_sleeper_and_of_what_moves_along(tmp_path):
    """``k + i w c - w^2 m``, of half a sleeper 1.6 times as heavy on 40 kg of ballast."""
    table = tmp_path / "supports.csv"
    table.write_text("number,sleeper_mass_factor\n5,1.6\n")
    expected = one_support(80e6 + 15e3j * OMEGA, 30e6 + 31e3j * OMEGA - OMEGA**2 * (75.0 + 40.0))
    found = study(*SOFT, f"track.supports={table}", "track.ballast_mass=40")
    assert np.abs(found.receptance(FREQUENCIES) / expected - 1.0).max() < 1e-6


def test_ballast_that_grows_heavier_under_a_preload():
    """With the secant stiffness ``k + s F`` of Eq. (26)."""
    secant = 30e6 + 2e3 * 20e3
    bed = secant**2 / 30e6 + 1j * OMEGA * 31e3 / 30e6 * secant - OMEGA**2 * 40.0 * secant / 30e6
    expected = one_support(80e6 + 15e3j * OMEGA, bed)
    keys = ("track.ballast_mass=40", "track.ballast_mass_grows=true", "track.ballast=hyperbolic")
    found = study(*SOFT, *keys, preload=20e3).receptance(FREQUENCIES)
    assert np.abs(found / expected - 1.0).max() < 1e-6


def test_heavier_sleepers_everywhere_are_another_nominal_track(tmp_path):
    table = tmp_path / "supports.csv"
    rows = "".join(f"{i},1.6\n" for i in range(1, 10))
    table.write_text(f"number,sleeper_mass_factor\n{rows}")
    found = study(f"track.supports={table}").receptance(FREQUENCIES)
    nominal = study("track.sleeper_mass=200").receptance(FREQUENCIES)
    assert found == pytest.approx(nominal, rel=1e-9)
    along = study("track.sleeper_mass=150", "track.ballast_mass=50").receptance(FREQUENCIES)
    assert along == pytest.approx(nominal, rel=1e-9)


@pytest.mark.parametrize("preload", [0.0, 60e3])
@pytest.mark.parametrize("special", [("variation.hanging_sleepers=4",), ("track.ballast_mass=40",)])
def test_all_modes_are_the_whole_track(preload, special):
    masses = ("variation.sleeper_mass_deviation=0.3", *special)
    keys = (PAD, *DIFFERENT, *masses, "track.elements_per_bay=4")
    case = study(*keys, "track.mode_pairs=87", preload=preload, load=Place(position=3.0))
    direct, modal = (case.receptance(FREQUENCIES[1:], name) for name in ("direct", "modal"))
    assert np.abs(modal / direct - 1.0).max() < 1e-7


def sinking(scenario, force):
    """Rail displacement under a standing load, all supports in their matrices [m]."""
    laws = support_laws(scenario, scenario.track, all_in_matrices=True)
    parameters = track_parameters(scenario.track)
    matrices = laws.base.put_into(assemble(parameters), laws.supports.nominal)
    full = FullTrack(parameters, matrices, pad_ports=laws.pads_have_ports)
    point = track_point(parameters, ABOVE)
    element = round(ABOVE.position / parameters.element_length) - 1
    shape = full.wheels(np.array([element]), np.array([[0.0, 0.0, 1.0, 0.0]]))
    load = force * np.asarray(shape.output)[0, : matrices.numbering.size]
    displacement, _ = static_start(matrices, laws, load=load, load_rate=np.zeros_like(load))
    free = point.dofs >= 0
    assert port_incidence(matrices, pad_ports=False).shape[1] == parameters.supports
    return point.weights[free] @ displacement[point.dofs[free]]


@pytest.mark.parametrize(
    "keys",
    [
        (PAD, "track.ballast_pulls=false", *DIFFERENT),
        ("variation.missing_fastenings=3-6", "variation.missing_pads=6", *DIFFERENT),
        (f"track.ballast={EXAMPLES / 'ballast.csv'}", "variation.hanging_sleepers=4-5"),
    ],
    ids=["relaxing, does not pull", "loose", "table, hanging"],
)
def test_the_static_receptance_under_a_preload_is_the_slope_of_the_sinking(keys):
    case = study(*keys, preload=80e3)
    ends = [sinking(case.scenario, 80e3 + d) for d in (-1.0, 1.0)]
    assert case.receptance(np.zeros(1))[0].real == pytest.approx(
        0.5 * (ends[1] - ends[0]), rel=1e-5
    )


def test_an_unloaded_nominal_track_has_nothing_beside_its_matrices():
    scenario = read_scenario(None, SMALL)
    point = track_point(track_parameters(scenario.track), ABOVE)
    assert support_tangent(scenario, point=point, force=0.0) is None


@pytest.mark.parametrize("keys", [DIFFERENT, ("variation.hanging_sleepers=4",)])
def test_an_unloaded_track_does_not_feel_whether_its_ballast_pulls(keys):
    """Its weight presses it, by more than small motions take off."""
    held, loose = (study(f"track.ballast_pulls={pulls}", *keys) for pulls in ("true", "false"))
    assert loose.receptance(FREQUENCIES) == pytest.approx(held.receptance(FREQUENCIES), rel=1e-9)


def test_what_just_touches_has_no_receptance_without_a_preload():
    keys = "variation.missing_fastenings=4"
    with pytest.raises(InputError, match=r"a rail that is not fastened just .* or give a preload"):
        study(keys).receptance(FREQUENCIES)
    assert np.isfinite(study(keys, preload=50e3).receptance(FREQUENCIES)).all()


def test_ballast_with_a_mass_that_a_sleeper_leaves_behind_has_no_receptance():
    keys = ("track.ballast_mass=40", "variation.hanging_sleepers=4")
    with pytest.raises(InputError, match=r"40 kg and a sleeper can lift off .* close the gaps"):
        study(*keys, preload=50e3).receptance(FREQUENCIES)


def test_what_the_simulation_refuses_has_no_receptance():
    keys = ("track.sleeper=beam", "variation.sleeper_mass_deviation=0.2")
    with pytest.raises(InputError, match="sleepers bend, but their masses differ"):
        study(*keys).receptance(FREQUENCIES)


def test_a_falling_law_has_no_receptance():
    """``30e6 x - 220e9 x^2 + 450e12 x^3`` falls from 0.10 to 0.23 mm."""
    keys = ("track.ballast_alpha=-220e9", "track.ballast_beta=450e12", "track.ballast_delta=0")
    with pytest.raises(RunError, match="falls with its displacement"):
        study(*keys, preload=8e3).receptance(FREQUENCIES)
