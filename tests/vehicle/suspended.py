"""Suspended vehicles of the tests, and their matrices put together by hand."""

import numpy as np

from vehicle_fmu.suspension import Suspension
from vehicle_fmu.suspension_parameters import (
    GRAVITY,
    BodyParameters,
    SuspensionElement,
    Tread,
)

WHEEL, BOGIE, INERTIA, CAR, CAR_INERTIA = 906.5, 1307.5, 738.0, 16_000.0, 985e3
LOAD = (CAR + 2.0 * BOGIE + 4.0 * WHEEL) * GRAVITY / 4.0
PRIMARY, SECONDARY = (1.2e6, 4e3), (430e3, 20e3)
HALF_BASE, HALF_PIVOT = 1.28, 9.5
OFFSETS = (0.0, 2.56, 19.0, 21.56)
TREAD = (300.0, 8e8, 2e3)


def coach(*, tread=None, primary=PRIMARY, secondary=SECONDARY, **stops):
    """The passenger coach of the Manchester benchmarks over one rail."""
    return Suspension(
        offsets=OFFSETS,
        wheel_mass=WHEEL,
        load=LOAD,
        tread=None if tread is None else Tread(mass=tread[0], stiffness=tread[1], damping=tread[2]),
        bogies=2,
        bodies=BodyParameters(
            bogie_mass=(BOGIE, BOGIE),
            bogie_pitch_inertia=(INERTIA, INERTIA),
            car_mass=CAR,
            car_pitch_inertia=CAR_INERTIA,
            primary=SuspensionElement(stiffness=primary[0], damping=primary[1], **stops),
            secondary=SuspensionElement(stiffness=secondary[0], damping=secondary[1]),
        ),
    )


def matrix_of(primary, secondary):
    """Stiffness or damping of the coach on held wheels: two bogies' bounce and pitch, car body.

    Written down body by body from the free-body diagrams.
    """
    k, s, a, b = primary, secondary, HALF_BASE, HALF_PIVOT
    return np.array(
        [
            [2 * k + s, 0, 0, 0, -s, -s * b],
            [0, 2 * k + s, 0, 0, -s, s * b],
            [0, 0, 2 * k * a * a, 0, 0, 0],
            [0, 0, 0, 2 * k * a * a, 0, 0],
            [-s, -s, 0, 0, 2 * s, 0],
            [-s * b, s * b, 0, 0, 0, 2 * s * b * b],
        ]
    )


MASS = np.diag([BOGIE, BOGIE, INERTIA, INERTIA, CAR, CAR_INERTIA])
