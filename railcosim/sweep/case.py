"""One case of a study: a passage, and the build of the FMUs that runs it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Annotated, TypeAlias, cast

from ..builds import has_own_fmu, usual_build
from ..coupled_system import with_steps_for
from ..field_rules import Choice
from ..fields import check_fields
from ..input_tables import check_profiles
from ..motion import speed_law
from ..start_values import track_constants

if TYPE_CHECKING:
    from collections.abc import Hashable, Mapping

    from ..scenario import Scenario
    from ..signals import ContactSide

Swept: TypeAlias = bool | int | float | str
"""Value of a swept key."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Options:
    """Keys of ``options``: what `railcosim run` is told besides the scenario.

    Attributes
    ----------
    contact : str
        Which of the two FMUs has the contacts.
    fmus : str, optional
        Which build of the FMUs runs; see `build`.
    """

    contact: Annotated[str, Choice(("vehicle", "track"))] = "vehicle"
    fmus: Annotated[str | None, Choice(("python", "native"))] = None

    def __post_init__(self) -> None:
        check_fields(self, "options")

    @property
    def side(self) -> ContactSide:
        """Which of the two FMUs has the contacts."""
        return cast("ContactSide", self.contact)

    @property
    def build(self) -> str:
        """Which build of the FMUs runs; without a choice that of `railcosim run`."""
        return self.fmus or usual_build(self.side)

    def resolved(self) -> Options:
        """Return the same options with the build chosen."""
        return replace(self, fmus=self.build)


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A passage of a study.

    Attributes
    ----------
    number : int
        Place among the cases, from 1.
    swept : mapping of str to value
        The keys that differ from case to case, as the study writes them.
    scenario : Scenario
        What is run.
    options : Options
        With which FMUs.
    """

    number: int
    swept: Mapping[str, Swept]
    scenario: Scenario
    options: Options = field(default_factory=Options)

    @property
    def name(self) -> str:
        """The number and the swept keys, for messages."""
        keys = ", ".join(f"{key} = {value}" for key, value in self.swept.items())
        return f"case {self.number} ({keys})"

    @property
    def resolved(self) -> Scenario:
        """The scenario with every value that is worked out written into its key."""
        return with_steps_for(self.scenario, self.options.side).resolved()

    @property
    def fmu_group(self) -> Hashable:
        """What cases with the same FMUs have in common."""
        scenario = self.scenario
        own = tuple(track_constants(scenario).items()) if self.has_own_fmu else ()
        size = scenario.track.bays, scenario.track.elements_per_bay, scenario.vehicle.wheels
        return self.options, size, own

    @property
    def has_own_fmu(self) -> bool:
        """Whether its track has an FMU of its own."""
        return has_own_fmu(self.scenario, self.options.build)

    def check_files(self) -> None:
        """Read the files that the scenario names.

        Raises
        ------
        InputError
            For a file that cannot be used.
        """
        speed_law(self.scenario.vehicle)
        check_profiles(self.scenario)
