"""The section `[variation]` of a scenario: what makes one support differ from the next."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from .errors import InputError
from .field_rules import Number, Numbers
from .fields import check_fields

LISTS = ("hanging_sleepers", "missing_fastenings", "missing_pads")
"""Keys that name supports."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Variation:
    """Keys of ``[variation]``; supports count from 1, one sleeper spacing from 0 m.

    Attributes
    ----------
    seed : int
        Of the random fields.
    correlation_length : float
        Distance over which their correlation falls to 1/e [m]; 0: every support by itself.
    pad_stiffness_deviation, ballast_stiffness_deviation : float
        Standard deviation of the logarithm of stiffness and damping; the median is the track's.
    sleeper_mass_deviation : float
        Likewise of the mass of sleepers that are rigid.
    transition_begin, transition_length : float
        Where the ballast stiffness begins to change, and over which distance [m].
    transition_factor : float
        Ballast stiffness and damping behind, over those before.
    hanging_sleepers : str
        Sleepers with a gap under them, as ``24-26, 30``.
    hanging_gap : float
        That gap [m].
    missing_fastenings : str
        Supports off which the rail can lift.
    missing_pads : str
        Supports without any force between rail and sleeper.
    """

    seed: Annotated[int, Number(at_least=0)] = 1
    correlation_length: Annotated[float, Number(unit="m", at_least=0.0)] = 0.0
    pad_stiffness_deviation: Annotated[float, Number(at_least=0.0, at_most=2.0)] = 0.0
    ballast_stiffness_deviation: Annotated[float, Number(at_least=0.0, at_most=2.0)] = 0.0
    sleeper_mass_deviation: Annotated[float, Number(at_least=0.0, at_most=0.5)] = 0.0
    transition_begin: Annotated[float, Number(unit="m", at_least=0.0)] = 0.0
    transition_length: Annotated[float, Number(unit="m", at_least=0.0)] = 0.0
    transition_factor: Annotated[float, Number(at_least=0.01, at_most=100.0)] = 1.0
    hanging_sleepers: Annotated[str, Numbers()] = ""
    hanging_gap: Annotated[float, Number(unit="m", at_least=0.0, at_most=0.1)] = 1e-3
    missing_fastenings: Annotated[str, Numbers()] = ""
    missing_pads: Annotated[str, Numbers()] = ""

    def __post_init__(self) -> None:
        for key in LISTS:
            value = getattr(self, key)
            if isinstance(value, int) and not isinstance(value, bool):
                object.__setattr__(self, key, str(value))  # one support, written as a number
        check_fields(self, "variation")

    @property
    def is_any(self) -> bool:
        """Whether there is a key that is not as if there were no section."""
        return self != Variation()

    def listed(self, key: str, supports: int) -> list[int]:
        """Return which of so many supports a key of `LISTS` names, counted from 0."""
        parts = Numbers.read(getattr(self, key))
        return [k for part in parts for k in range(part[0] - 1, min(part[-1], supports))]

    def last_listed(self) -> dict[str, int]:
        """Return the largest number that each key of `LISTS` names, 0 where it names none."""
        return {
            key: max((part[-1] for part in Numbers.read(getattr(self, key))), default=0)
            for key in LISTS
        }

    def check_supports(self, supports: int) -> None:
        """Refuse lists that name supports which a track does not have.

        Raises
        ------
        InputError
            With the key and the number.
        """
        for key, last in self.last_listed().items():
            if last > supports:
                raise InputError(
                    f"variation.{key} names support {last} but the track has {supports}: name "
                    "others or raise track.bays"
                )
