"""What the file of an FMU says, for every participant that drives it."""

from collections.abc import Mapping
from pathlib import Path

from ..participant import Variable
from ..units import Unit
from .reading import read_fmu


class DescribedFmu:
    """A participant's knowledge of its FMU.

    Parameters
    ----------
    path : str or pathlib.Path
        The FMU; it is read and checked at once.

    Raises
    ------
    FmuError
        When the file is not usable.
    """

    def __init__(self, path: str | Path) -> None:
        self._description = read_fmu(Path(path))

    @property
    def variables(self) -> Mapping[str, Variable]:
        """Every variable by name."""
        return self._description.variables

    @property
    def units(self) -> Mapping[str, Unit]:
        """Every unit that it defines in SI base units, by name."""
        return self._description.units

    @property
    def can_save_state(self) -> bool:
        """Whether it claims to save and restore states."""
        return self._description.can_save_state

    @property
    def can_serialise_state(self) -> bool:
        """Whether it claims to serialise them."""
        return self._description.can_serialise_state

    @property
    def can_vary_step(self) -> bool:
        """Whether it claims canHandleVariableCommunicationStepSize."""
        return self._description.can_vary_step

    @property
    def dependencies(self) -> Mapping[str, frozenset[str] | None]:
        """For every output the inputs in its ModelStructure; None where that is silent."""
        return self._description.dependencies

    @property
    def initial_dependencies(self) -> Mapping[str, frozenset[str] | None]:
        """For every output the inputs in its InitialUnknowns; None where they are silent."""
        return self._description.initial_dependencies

    @property
    def provides_directional_derivatives(self) -> bool:
        """Whether it claims providesDirectionalDerivative."""
        return self._description.provides_directional_derivatives
