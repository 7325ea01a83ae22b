import pytest

from vehicle_fmu.parameters import FlatParameters, VehicleParameters
from vehicle_fmu.speed import ConstantSpeed
from vehicle_fmu.vehicle_model import VehicleModel

ROUND = FlatParameters(shape="none")


@pytest.fixture
def make_vehicle():
    """Build a vehicle at 40 km/h, initialised at t = 0 on an undeformed rail."""

    def make(*, flat=ROUND, speed=None, flat_table=None, irregularity=None, **parameters):
        vehicle = VehicleModel(
            VehicleParameters(**parameters),
            flat=flat,
            speed=speed or ConstantSpeed(speed=40.0 / 3.6),
            flat_table=flat_table,
            irregularity=irregularity,
        )
        vehicle.initialise(0.0)
        return vehicle

    return make
