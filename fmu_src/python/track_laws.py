"""Laws of pads and ballast from the parameters of a track FMU; tables are read from their files."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from track_fmu.ballast import PolynomialBallast
from track_fmu.characteristics import (
    Characteristic,
    HyperbolicCharacteristic,
    LinearCharacteristic,
    PolynomialCharacteristic,
    TableCharacteristic,
)
from track_fmu.component_law import ComponentLaw
from track_fmu.heavy_ballast import HeavyBallast
from track_fmu.pads import TotalPad
from track_fmu.parameters import GRAVITY, TrackParameters
from track_fmu.preloaded_pad import PreloadedPad
from track_fmu.support_factors import SupportFactors
from track_fmu.total_ballast import TotalBallast
from track_fmu.viscoelastic_pads import ViscoelasticPads

from .supports import support_factors
from .tables import read_table

CHARACTERISTIC = ("displacement", "load")
PRELOADED = ("preload", "static_stiffness", "branch_stiffness", "branch_damping")


def make_laws(
    track: TrackParameters, parameters: Mapping[str, Any], factors: SupportFactors | None = None
) -> tuple[ComponentLaw | None, ComponentLaw | None]:
    """Laws of the increments of ballast and pads; None is linear and the same at every support.

    The supports have what the parameters say of them, unless the factors are given.

    Raises
    ------
    ValueError
        If a parameter is wrong or a table cannot be used.
    """
    if factors is None:
        factors = support_factors(track, parameters)
    if track.sleeper != "rigid" and (factors.ballast_differs or not parameters["ballast_pulls"]):
        raise ValueError(
            "track: sleepers bend, but their ballast differs or does not pull; leave one of the "
            "two out"
        )
    if track.sleeper != "rigid" and factors.sleepers_differ:
        raise ValueError("track: sleepers bend, but their masses differ; leave one of the two out")
    return _ballast_law(track, parameters, factors), _pad_law(track, parameters, factors)


def _ballast_law(
    track: TrackParameters, parameters: Mapping[str, Any], factors: SupportFactors
) -> ComponentLaw | None:
    kind, pulls = parameters["ballast"], bool(parameters["ballast_pulls"])
    coefficients = {name: parameters[f"ballast_{name}"] for name in ("alpha", "beta", "delta")}
    tangent = bool(parameters["ballast_tangent_damping"])
    mass = parameters["ballast_mass"]
    inertial = mass != 0.0 or factors.sleepers_differ
    if pulls and not (factors.ballast_differs or inertial):
        if kind == "linear":
            return None
        if kind == "state_dependent" and not tangent:
            tau = track.ballast_damping / track.ballast_stiffness
            return PolynomialBallast(**coefficients, tau=tau)
    characteristic: Characteristic
    if kind == "linear":
        characteristic = LinearCharacteristic()
    elif kind == "state_dependent":
        characteristic = PolynomialCharacteristic(**coefficients)
    elif kind == "hyperbolic":
        characteristic = HyperbolicCharacteristic(
            stiffness=track.ballast_stiffness, slope=parameters["ballast_slope"]
        )
    elif kind.lower().endswith(".csv"):
        characteristic = table_characteristic(
            "ballast", kind, read_table(kind, CHARACTERISTIC), track.ballast_stiffness
        )
    else:
        raise ValueError(
            f"track: ballast is {kind!r}; it must be 'state_dependent', 'linear', 'hyperbolic' or "
            "a .csv file"
        )
    bed = TotalBallast(
        characteristic=characteristic,
        linear_stiffness=track.ballast_stiffness,
        linear_damping=track.ballast_damping,
        factors=factors,
        sleeper_weight=GRAVITY * track.sleeper_mass,
        rail_weight=GRAVITY * track.mass_per_length * track.sleeper_spacing,
        tangent_damping=tangent,
        pulls=pulls,
    )
    if not inertial:
        return bed
    return HeavyBallast(
        bed=bed,
        mass=mass,
        grows=bool(parameters["ballast_mass_grows"]),
        nominal_sleeper=track.sleeper_mass,
    )


def _pad_law(
    track: TrackParameters, parameters: Mapping[str, Any], factors: SupportFactors
) -> ComponentLaw | None:
    path = parameters["pad"]
    if path == "linear" and not factors.pads_differ:
        return None
    common: dict[str, Any] = {
        "linear_stiffness": track.pad_stiffness,
        "linear_damping": track.pad_damping,
        "factors": factors,
    }
    if path == "linear":
        return TotalPad(characteristic=LinearCharacteristic(), **common)
    if not path.lower().endswith(".csv"):
        raise ValueError(f"track: pad is {path!r}; it must be 'linear' or a .csv file")
    columns = read_pad(path)
    if len(columns) == len(CHARACTERISTIC):
        table = table_characteristic("pad", path, columns, track.pad_stiffness)
        return TotalPad(characteristic=table, **common)
    pad = preloaded_pad(path, columns, parameters["clip_preload"])
    return ViscoelasticPads(pad=pad, **common)


def preloaded_pad(path: str, columns: Mapping[str, Any], clip_preload: float) -> PreloadedPad:
    """Pad whose parameters depend on its preload, from the columns of a table.

    Raises
    ------
    ValueError
        If there is no such pad.
    """
    try:
        return PreloadedPad(**columns, clip_preload=clip_preload)
    except ValueError as error:
        raise ValueError(f"table {path}: {error}") from error


def read_pad(path: str) -> dict[str, Any]:
    """Columns of a pad's table, by the names that their number gives them."""
    columns = read_table(path, PRELOADED[:2], optional=PRELOADED[2:])
    if len(columns) == len(CHARACTERISTIC):
        return dict(zip(CHARACTERISTIC, columns.values(), strict=True))
    if len(columns) != len(PRELOADED):
        raise ValueError(
            f"table {path}: has {len(columns)} columns, but a pad has {len(CHARACTERISTIC)} "
            f"({', '.join(CHARACTERISTIC)}) or {len(PRELOADED)} ({', '.join(PRELOADED)})"
        )
    return columns


def table_characteristic(
    what: str, path: str, columns: Mapping[str, Any], stiffness: float
) -> TableCharacteristic:
    """Characteristic through the rows of a table.

    Raises
    ------
    ValueError
        If it is no rising curve through the origin.
    """
    try:
        return TableCharacteristic(columns["displacement"], columns["load"], stiffness=stiffness)
    except ValueError as error:
        raise ValueError(f"{what}, table {path}: {error}") from error
