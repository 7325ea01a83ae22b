"""Participants and the connections between them, checked."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from .errors import WiringError, close_matches
from .participant import Participant, Variable
from .units import Linear


@dataclass(frozen=True, slots=True, kw_only=True)
class Connection:
    """An output that drives an input.

    Attributes
    ----------
    source, target : str
        ``participant.variable`` of the output and of the input.
    conversion : Linear or None
        What the input takes of the output's value, its unit included; None hands the value on as it
        is, and the units have to be the same.
    """

    source: str
    target: str
    conversion: Linear | None = None


class System:
    """A co-simulation model.

    Parameters
    ----------
    participants : sequence of Participant
        The partners; their order decides wherever nothing else does.
    connections : sequence of Connection
        Which output drives which input.

    Raises
    ------
    WiringError
        For unknown or repeated names, an input driven twice, a connection that does not run from
        a Real output to a Real input, units that differ without a conversion, or a conversion
        that is no use.
    """

    def __init__(
        self, participants: Sequence[Participant], connections: Sequence[Connection]
    ) -> None:
        self.participants = tuple(participants)
        self.connections = tuple(connections)
        self._index = {item.name: place for place, item in enumerate(self.participants)}
        self._check_names()
        for connection in self.connections:
            self._check_connection(connection)
        targets = Counter(connection.target for connection in self.connections)
        for target, count in targets.items():
            if count > 1:
                sources = [item.source for item in self.connections if item.target == target]
                raise WiringError(
                    f"{target} is driven by {count} connections, from {' and '.join(sources)}; "
                    "an input takes one."
                )

    def find(self, path: str) -> tuple[int, Variable]:
        """Return the place of the participant and the variable that `path` names.

        Raises
        ------
        WiringError
            When there is no such participant or variable.
        """
        name, dot, variable = path.partition(".")
        if not dot:
            raise WiringError(f"{path!r} is not of the form 'participant.variable'.")
        if name not in self._index:
            raise WiringError(
                f"{path!r}: there is no participant {name!r}; {close_matches(name, self._index)}."
            )
        place = self._index[name]
        known = self.participants[place].variables
        if variable not in known:
            raise WiringError(
                f"{path!r}: {name} has no variable {variable!r}; {close_matches(variable, known)}."
            )
        return place, known[variable]

    def variables(self) -> dict[str, Variable]:
        """Return every variable of every participant by ``participant.variable``."""
        return {
            f"{participant.name}.{variable.name}": variable
            for participant in self.participants
            for variable in participant.variables.values()
        }

    def _check_names(self) -> None:
        if not self.participants:
            raise WiringError("A system needs at least one participant.")
        counts = Counter(item.name for item in self.participants)
        for name, count in counts.items():
            if count > 1:
                raise WiringError(f"{count} participants are called {name!r}; names are unique.")
            if not name or "." in name:
                raise WiringError(f"{name!r} is no name for a participant: no dot, not empty.")

    def _check_connection(self, connection: Connection) -> None:
        _, source = self.find(connection.source)
        _, target = self.find(connection.target)
        arrow = f"{connection.source} -> {connection.target}"
        if source.causality != "output":
            raise WiringError(f"{arrow}: {connection.source} is no output but {source.causality}.")
        if target.causality != "input":
            raise WiringError(f"{arrow}: {connection.target} is no input but {target.causality}.")
        for path, variable in ((connection.source, source), (connection.target, target)):
            if variable.type != "Real":
                raise WiringError(
                    f"{arrow}: {path} is of type {variable.type}, but only Real can be coupled."
                )
        if connection.conversion is not None:
            if not connection.conversion.is_sound:
                raise WiringError(
                    f"{arrow}: the factor {connection.conversion.factor} must be finite and not "
                    f"zero, the offset {connection.conversion.offset} finite."
                )
        elif source.unit and target.unit and source.unit != target.unit:
            raise WiringError(
                f"{arrow}: the units {source.unit!r} and {target.unit!r} differ; "
                "give both sides the same, or the connection a conversion."
            )
