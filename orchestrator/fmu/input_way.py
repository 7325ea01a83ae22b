"""How an FMU is given inputs that run on straight lines over a step, if it can take them."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from ..participant import InputShape
from .description import FmuDescription, StartValue

linear_inputs = "linear_inputs"
"""Boolean parameter of FMUs that can take their inputs as straight lines over the step."""


class InputWay(NamedTuple):
    """How inputs run over a step, and by which means.

    Attributes
    ----------
    shape : {'held', 'linear'}
        How they run.
    uses_slopes : bool
        Whether the derivatives of FMI 2.0 are set.
    start_values : mapping of str to float, int, bool or str
        Parameters that must be set for it.
    """

    shape: InputShape = "held"
    uses_slopes: bool = False
    start_values: Mapping[str, StartValue] = MappingProxyType({})

    @property
    def words(self) -> str:
        """The same as an adverb."""
        if self.shape == "held":
            return "held"
        means = "derivatives of FMI 2.0" if self.uses_slopes else f"parameter {linear_inputs}"
        return f"on straight lines, by the {means}"


def choose_input_way(
    description: FmuDescription,
    start_values: Mapping[str, StartValue],
    inputs: Sequence[str],
    *,
    wish: InputShape,
) -> InputWay:
    """Return the first way that the FMU has: derivatives, the parameter, held inputs.

    Parameters
    ----------
    description : FmuDescription
        The FMU.
    start_values : mapping of str to float, int, bool or str
        What the user set: a value of ``linear_inputs`` among it decides alone.
    inputs : sequence of str
        The inputs in use.
    wish : {'held', 'linear'}
        What the master would like.
    """
    flag = description.variables.get(linear_inputs)
    has_flag = flag is not None and flag.type == "Boolean"
    if has_flag and linear_inputs in start_values:
        return InputWay("linear" if start_values[linear_inputs] else "held")
    continuous = any(description.variables[name].variability == "continuous" for name in inputs)
    if wish == "linear" and description.can_interpolate_inputs and continuous:
        return InputWay("linear", True, {linear_inputs: False} if has_flag else {})
    if has_flag:
        return InputWay(wish, False, {linear_inputs: wish == "linear"})
    return InputWay()
