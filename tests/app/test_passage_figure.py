import numpy as np
import pytest

from railcosim.figures.passage import SPAN, describe, draw_passage
from railcosim.scenario import Scenario
from railcosim.sections import Flat
from railcosim.track_section import Track
from railcosim.vehicle_section import Vehicle

DISTANCE = np.linspace(-3.9, 2.6, 651)


def test_three_panels_show_the_drawn_part_of_the_run(make_passage):
    force = np.where(np.abs(DISTANCE) < 0.1, 2e5, 1e5)
    figure = draw_passage(make_passage(DISTANCE, series={"contact_force": {1: force}}))
    panels = figure.axes
    assert [axes.get_ylabel().split(" [")[1] for axes in panels] == ["kN]", "mm]", "kN m]"]
    drawn = panels[0].lines[0]
    assert drawn.get_label() == "wheel 1"
    assert drawn.get_xdata()[[0, -1]] == pytest.approx(SPAN, abs=1e-9)
    assert drawn.get_ydata().max() == pytest.approx(200.0, rel=1e-12)


def test_loss_of_contact_is_shaded_where_the_gap_is_open(make_passage):
    gap = np.where((DISTANCE > -0.041) & (DISTANCE < 0.021), 1e-4, -1e-4)
    axes = draw_passage(make_passage(DISTANCE, series={"gap": {1: gap}})).axes[0]
    (shade,) = axes.patches
    assert shade.get_x() == pytest.approx(-0.045, abs=1e-9)
    assert shade.get_x() + shade.get_width() == pytest.approx(0.025, abs=1e-9)
    assert shade.get_label() == "wheel 1 off the rail"


def test_without_a_flat_distances_count_from_a_place(make_passage):
    scenario = Scenario(flat=Flat(shape="none", position=16.25))
    label = draw_passage(make_passage(DISTANCE, scenario)).axes[2].get_xlabel()
    assert label == "distance of wheel 1 from 16.25 m along the rail [m]"


def test_every_wheel_has_its_own_colour_and_the_flats_wheel_always_the_same(make_passage):
    scenario = Scenario(vehicle=Vehicle(wheels=4), flat=Flat(wheel=3))
    lines = draw_passage(make_passage(DISTANCE, scenario)).axes[0].lines
    colours = {line.get_label(): line.get_color() for line in lines}
    wheels = [colours[f"wheel {k}"] for k in range(1, 5)]
    assert len(set(wheels)) == 4
    first = draw_passage(make_passage(DISTANCE)).axes[0].lines[0]
    assert first.get_color() == colours["wheel 3"]


def test_a_run_that_was_interrupted_early_can_be_drawn(make_passage):
    figure = draw_passage(make_passage([-3.9, -3.0], complete=False))
    assert figure.axes[0].lines[0].get_xdata().size == 0


@pytest.mark.parametrize(
    ("scenario", "text"),
    [
        (
            Scenario(),
            "40 km/h, haversine 100 mm x 0.9 mm flat on wheel 1, state-dependent track",
        ),
        (
            Scenario(track=Track(ballast="linear"), flat=Flat(shape="chord", wheel=2)),
            "40 km/h, chord 100 mm flat on wheel 2, linear track",
        ),
        (
            Scenario(vehicle=Vehicle(speed_kmh=72.5), flat=Flat(shape="none")),
            "72.5 km/h, round wheels, state-dependent track",
        ),
        (
            Scenario(vehicle=Vehicle(speed_table="v.csv"), flat=Flat(shape="tread.csv")),
            "speed table, measured flat on wheel 1, state-dependent track",
        ),
        (
            Scenario(track=Track(ballast="/somewhere/ballast_2.csv"), flat=Flat(shape="none")),
            "40 km/h, round wheels, ballast_2.csv track",
        ),
    ],
)
def test_a_passage_is_described_by_what_its_shape_uses(scenario, text):
    assert describe(scenario) == text
