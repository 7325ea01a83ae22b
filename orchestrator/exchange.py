"""All values that pass between participants, in flat arrays laid out once."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .errors import WiringError
from .participant import InputShape, Variable, Vector
from .stage import Indices, Stage
from .system import System
from .units import Linear, identity


@dataclass(frozen=True, slots=True, kw_only=True)
class Wire:
    """An input and the output that drives it, as places in the flat arrays.

    Attributes
    ----------
    source_stage, target_stage : int
        Places of the two participants.
    output, input : int
        Places in `Exchange.outputs` and `Exchange.inputs`.
    value : int
        Place among the exchanged values.
    """

    source_stage: int
    target_stage: int
    output: int
    input: int
    value: int


class Exchange:
    """Participants bound to flat arrays of inputs, outputs and observed values.

    Parameters
    ----------
    system : System
        Participants and connections.
    indicators : sequence of str
        Outputs that are read with the exchanged ones.
    observed : sequence of str
        Variables that are read at accepted points only.
    input_shape : {'held', 'linear'}
        How inputs should run over a step.

    Attributes
    ----------
    stages : tuple of Stage
        One per participant, in the order of the system.
    inputs, outputs, observed : numpy.ndarray
        The flat arrays; every stage holds views of them. Inputs are in the units of their sources:
        a stage converts them on their way into the participant.
    wires : tuple of Wire
        One per connection.
    value_names : tuple of str
        Exchanged values: the distinct outputs that drive something.
    value_places : numpy.ndarray of int, shape (n_values,)
        Their places in `outputs`.
    nominal, lower, upper : numpy.ndarray, shape (n_values,)
        Smallest nominal value and tightest bounds that output or inputs declare, in the unit of
        the output.
    continuous : numpy.ndarray of bool, shape (n_values,)
        Whether the value is continuous in time.
    indicator_places : numpy.ndarray of int
        Places of the indicators in `outputs`.
    observed_variables : mapping of str to Variable
        What `observed` holds, in order.
    """

    def __init__(
        self,
        system: System,
        *,
        indicators: Sequence[str],
        observed: Sequence[str],
        input_shape: InputShape,
    ) -> None:
        targets = [item.target for item in system.connections]
        sources = list(dict.fromkeys(item.source for item in system.connections))
        for path in indicators:
            _check_indicator(path, system.find(path)[1])
        input_paths = _by_participant(system, targets)
        output_paths = _by_participant(system, list(dict.fromkeys([*sources, *indicators])))
        observed_paths = _by_participant(system, list(dict.fromkeys(observed)))
        self.input_names = tuple(path for group in input_paths for path in group)
        self.inputs, input_views = _allocate(input_paths)
        self.outputs, output_views = _allocate(output_paths)
        self.observed, observed_views = _allocate(observed_paths)
        self.observed_variables: Mapping[str, Variable] = {
            path: system.find(path)[1] for group in observed_paths for path in group
        }
        conversions = {item.target: item.conversion or identity for item in system.connections}
        stages = []
        for place, participant in enumerate(system.participants):
            names = [
                [path.partition(".")[2] for path in paths[place]]
                for paths in (input_paths, output_paths, observed_paths)
            ]
            participant.bind(
                inputs=names[0], outputs=names[1], observed=names[2], input_shape=input_shape
            )
            stages.append(
                Stage(
                    participant,
                    inputs=input_views[place],
                    outputs=output_views[place],
                    observed=observed_views[place],
                    input_names=names[0],
                    output_names=names[1],
                    observed_names=names[2],
                    conversions=[conversions[path] for path in input_paths[place]],
                )
            )
        self.stages = tuple(stages)
        places = {path: n for n, path in enumerate(p for group in output_paths for p in group)}
        self._lay_wires(system, places, sources)
        self.indicator_places: Indices = np.array([places[path] for path in indicators], np.intp)

    def _lay_wires(
        self, system: System, output_places: Mapping[str, int], sources: Sequence[str]
    ) -> None:
        input_places = {path: n for n, path in enumerate(self.input_names)}
        value_places = {path: n for n, path in enumerate(sources)}
        self.value_names = tuple(sources)
        self.value_places: Indices = np.array([output_places[path] for path in sources], np.intp)
        self.wires = tuple(
            Wire(
                source_stage=system.find(item.source)[0],
                target_stage=system.find(item.target)[0],
                output=output_places[item.source],
                input=input_places[item.target],
                value=value_places[item.source],
            )
            for item in system.connections
        )
        ends = [[(system.find(path)[1], identity)] for path in sources]
        for item in system.connections:
            end = system.find(item.target)[1], item.conversion or identity
            ends[value_places[item.source]].append(end)
        nominal = [[_nominal(*end) for end in sharing] for sharing in ends]
        bounds = [[_bounds(*end) for end in sharing] for sharing in ends]
        self.nominal: Vector = np.array(
            [min((size for size in sizes if size is not None), default=1.0) for sizes in nominal]
        )
        self.lower: Vector = np.array([max(low for low, _ in pairs) for pairs in bounds])
        self.upper: Vector = np.array([min(high for _, high in pairs) for pairs in bounds])
        self.continuous: NDArray[np.bool_] = np.array(
            [sharing[0][0].variability == "continuous" for sharing in ends], dtype=np.bool_
        )
        for name, low, high in zip(sources, self.lower, self.upper, strict=True):
            if low > high:
                raise WiringError(
                    f"{name}: the bounds of output and input leave no value, "
                    f"since the largest minimum {low:g} exceeds the smallest maximum {high:g}."
                )

    def list_inputs(self) -> dict[str, float]:
        """Return the present inputs of all participants by ``participant.variable``."""
        values = [value for stage in self.stages for value in stage.converted_inputs().tolist()]
        return dict(zip(self.input_names, values, strict=True))


def _nominal(variable: Variable, conversion: Linear) -> float | None:
    """Return the nominal value in the unit of the source."""
    return None if variable.nominal is None else variable.nominal / abs(conversion.factor)


def _bounds(variable: Variable, conversion: Linear) -> tuple[float, float]:
    """Return smallest and largest value in the unit of the source."""
    low, high = (conversion.invert(bound) for bound in (variable.minimum, variable.maximum))
    return (low, high) if conversion.factor > 0.0 else (high, low)


def _by_participant(system: System, paths: Sequence[str]) -> list[list[str]]:
    groups: list[list[str]] = [[] for _ in system.participants]
    for path in paths:
        groups[system.find(path)[0]].append(path)
    return groups


def _allocate(groups: Sequence[Sequence[str]]) -> tuple[Vector, list[Vector]]:
    ends = np.cumsum([0, *(len(group) for group in groups)])
    flat = np.zeros(ends[-1])
    return flat, [flat[ends[n] : ends[n + 1]] for n in range(len(groups))]


def _check_indicator(path: str, variable: Variable) -> None:
    if variable.type != "Real" or variable.causality != "output":
        raise WiringError(
            f"{path}: an event indicator is a signed Real output, but this is of the type "
            f"{variable.type} and of the causality {variable.causality}."
        )
