"""What a track with contacts is given of the wheels: Hertz's law and their surfaces."""

import numpy as np
import pytest

from vehicle_fmu.contact import hertz_force
from vehicle_fmu.hertz_contact import HertzContact
from vehicle_fmu.irregularity import RailIrregularity
from vehicle_fmu.parameters import FlatParameters
from vehicle_fmu.surfaces import Surfaces

COEFFICIENT = 9.17e10
FLAT = FlatParameters(shape="parabola", length=0.1, depth=1e-3, wheel=2, position=10.0)


def surfaces(flat=FLAT, irregularity=None, wheels=3):
    return Surfaces(flat, flat_table=None, irregularity=irregularity, wheels=wheels, radius=0.45)


def test_forces_are_those_of_one_wheel():
    law = HertzContact(COEFFICIENT)
    compression = np.array([-1e-4, 0.0, 1e-5, 1.2e-4])
    expected = [hertz_force(d, COEFFICIENT) for d in compression.tolist()]
    assert law.force(compression).tolist() == expected
    assert law.compression(law.force(compression[1:])) == pytest.approx(compression[1:], rel=1e-14)


def test_the_stiffness_is_the_derivative_of_the_force_and_vanishes_with_contact():
    law, step = HertzContact(COEFFICIENT), 1e-9
    compression = np.array([1e-5, 1.2e-4])
    slope = (law.force(compression + step) - law.force(compression - step)) / (2.0 * step)
    assert law.stiffness(compression) == pytest.approx(slope, rel=1e-6)
    assert law.stiffness(np.array([-1e-5, 0.0])).tolist() == [0.0, 0.0]


@pytest.mark.parametrize("coefficient", [0.0, -1.0, np.nan])
def test_an_impossible_coefficient_is_refused(coefficient):
    with pytest.raises(ValueError, match="hertz_coefficient is"):
        HertzContact(coefficient)


def test_only_the_wheel_with_the_flat_drops_by_it():
    drops = surfaces().drops
    assert drops(np.array([10.0, 10.0, 10.0])) == pytest.approx([0.0, 1e-3, 0.0], abs=1e-18)
    # a parabola is down by 3/4 at a quarter of its length from the centre
    assert drops(np.array([9.0, 10.025, 12.0]))[1] == pytest.approx(0.75e-3, rel=1e-12)


def test_every_wheel_meets_the_irregularity_where_it_is():
    rail = RailIrregularity(
        position=np.linspace(8.0, 12.0, 5), drop=np.array([0.0, 1e-4, 2e-4, 1e-4, 0.0])
    )
    drops = surfaces(irregularity=rail).drops(np.array([9.0, 10.0, 11.0]))
    assert drops == pytest.approx([1e-4, 1.2e-3, 1e-4], rel=1e-12)


def test_a_flat_on_no_wheel_is_refused():
    with pytest.raises(ValueError, match="flat is on wheel 2, the vehicle has 1"):
        surfaces(wheels=1)
