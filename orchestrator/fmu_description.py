"""Opening an FMU file: is it one, is it one the master can drive, and what does it contain."""

import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import fmpy
from fmpy.model_description import ValidationError, read_model_description

from .archives import find_danger
from .errors import FmuError, close_matches
from .participant import Variable
from .units import Unit, base_units

StartValue = float | int | bool | str


@dataclass(frozen=True, slots=True, kw_only=True)
class FmuDescription:
    """What the master needs to know of an FMI 2.0 co-simulation FMU.

    Attributes
    ----------
    path : pathlib.Path
        The archive.
    model_name, model_identifier, guid : str
        As in the model description.
    can_save_state, can_serialise_state, can_vary_step, provides_directional_derivatives : bool
        Its claims.
    dependencies : mapping of str to frozenset of str or None
        For every output the inputs that it depends on without delay; None: not said.
    initial_dependencies : mapping of str to frozenset of str
        The same for the initialisation, without the outputs of which nothing is said.
    variables : mapping of str to Variable
        Every variable by name.
    references : mapping of str to int
        Value reference of every variable.
    settable : frozenset of str
        Names that take a start value.
    units : mapping of str to Unit
        Units that the model description defines in SI base units, by name.
    """

    path: Path
    model_name: str
    model_identifier: str
    guid: str
    can_save_state: bool
    can_serialise_state: bool
    can_vary_step: bool
    provides_directional_derivatives: bool
    dependencies: Mapping[str, frozenset[str] | None]
    variables: Mapping[str, Variable]
    references: Mapping[str, int]
    settable: frozenset[str]
    units: Mapping[str, Unit]
    initial_dependencies: Mapping[str, frozenset[str]] = field(default_factory=dict)

    def check_start_values(self, values: Mapping[str, StartValue]) -> None:
        """Raise `FmuError` unless every value is known, settable and of the right type."""
        for name, value in values.items():
            if name not in self.variables:
                raise FmuError(
                    f"{self.path.name}: start value for the unknown variable {name!r}; "
                    f"{close_matches(name, self.variables)}."
                )
            if name not in self.settable:
                raise FmuError(
                    f"{self.path.name}: {name!r} takes no start value, because the FMU "
                    f"calculates it (causality {self.variables[name].causality})."
                )
            _check_type(self.path.name, self.variables[name], value)


def _check_type(file: str, variable: Variable, value: StartValue) -> None:
    wanted: tuple[type, ...] = {
        "Real": (float, int),
        "Integer": (int,),
        "Enumeration": (int,),
        "Boolean": (bool,),
        "String": (str,),
    }[variable.type]
    if not isinstance(value, wanted) or (isinstance(value, bool) and bool not in wanted):
        raise FmuError(
            f"{file}: start value {value!r} of {variable.name!r} is of type "
            f"{type(value).__name__}, but the variable is of type {variable.type}."
        )
    if not isinstance(value, str) and not variable.minimum <= value <= variable.maximum:
        raise FmuError(
            f"{file}: start value {value!r} of {variable.name!r} lies outside "
            f"[{variable.minimum:g}, {variable.maximum:g}]."
        )


def read_fmu(path: Path) -> FmuDescription:
    """Read and check the FMU at `path`.

    Raises
    ------
    FmuError
        When the file is missing, no zip archive, has no valid model description, is of another FMI
        version or kind, or has no binary for this platform.
    """
    model = _read_model(path)
    if model.fmiVersion != "2.0":
        raise FmuError(
            f"{path.name}: the FMU is of FMI version {model.fmiVersion}, but only 2.0 can be used."
        )
    if model.coSimulation is None:
        raise FmuError(
            f"{path.name}: the FMU is for model exchange only; export it for co-simulation."
        )
    platforms = fmpy.supported_platforms(path)
    if fmpy.platform not in platforms:
        raise FmuError(
            f"{path.name}: the FMU has no binary for {fmpy.platform}, "
            f"only for {', '.join(platforms) or 'no platform at all'}."
        )
    interface = model.coSimulation
    return FmuDescription(
        path=path,
        model_name=model.modelName,
        model_identifier=interface.modelIdentifier,
        guid=model.guid,
        can_save_state=bool(interface.canGetAndSetFMUstate),
        can_serialise_state=bool(interface.canSerializeFMUstate),
        can_vary_step=bool(interface.canHandleVariableCommunicationStepSize),
        provides_directional_derivatives=bool(interface.providesDirectionalDerivative),
        dependencies=_dependencies(model),
        initial_dependencies=_said(model.initialUnknowns),
        variables={item.name: _variable(item) for item in model.modelVariables},
        references={item.name: int(item.valueReference) for item in model.modelVariables},
        settable=frozenset(item.name for item in model.modelVariables if _takes_start(item)),
        units={
            item.name: _unit(item) for item in model.unitDefinitions if item.baseUnit is not None
        },
    )


def _read_model(path: Path) -> Any:  # noqa: ANN401 - fmpy carries no types
    if not path.is_file():
        raise FmuError(f"{path}: there is no such FMU file.")
    with TemporaryDirectory(prefix="fmu-") as folder:
        try:
            with zipfile.ZipFile(path) as archive:
                danger = find_danger(archive)
                if danger is not None:
                    raise FmuError(f"{path.name}: the archive is not unpacked: {danger}.")
                description = archive.extract("modelDescription.xml", folder)
        except (zipfile.BadZipFile, zlib.error) as error:
            raise FmuError(
                f"{path.name}: the file is no FMU, because it is no intact zip archive."
            ) from error
        except KeyError as error:
            raise FmuError(
                f"{path.name}: the file is no FMU, because it holds no modelDescription.xml."
            ) from error
        except OSError as error:
            raise FmuError(f"{path}: the file cannot be read ({error.strerror}).") from error
        return _parse(path.name, description)


def _parse(file: str, description: str) -> Any:  # noqa: ANN401 - fmpy carries no types
    if b"<!DOCTYPE" in Path(description).read_bytes():
        raise FmuError(
            f"{file}: a document type with its entities is refused in the model description."
        )
    try:
        return read_model_description(description, validate=True)
    except ValidationError as error:
        problem = " ".join(str(error.problems[0]).split())
        raise FmuError(f"{file}: the model description is not valid: {problem}") from error
    except Exception as error:  # fmpy raises plain Exception, lxml its own kinds
        problem = " ".join(str(error).split())
        raise FmuError(f"{file}: the model description cannot be read: {problem}") from error


def _dependencies(model: Any) -> dict[str, frozenset[str] | None]:  # noqa: ANN401 - no types
    """Return what each output depends on; one that the ModelStructure leaves out may on all."""
    known = {item.name: None for item in model.modelVariables if item.causality == "output"}
    return {**known, **_said(model.outputs)}


def _said(unknowns: Any) -> dict[str, frozenset[str]]:  # noqa: ANN401 - fmpy carries no types
    return {
        item.variable.name: frozenset(
            other.name for other in item.dependencies if other.causality == "input"
        )
        for item in unknowns
        if item.dependencies is not None and item.variable.causality == "output"
    }


def _takes_start(item: Any) -> bool:  # noqa: ANN401 - fmpy carries no types
    if item.variability == "constant" or item.causality == "independent":
        return False
    return item.causality == "input" or item.initial in {"exact", "approx"}


def _unit(item: Any) -> Unit:  # noqa: ANN401 - fmpy carries no types
    base = item.baseUnit
    return Unit(
        name=item.name,
        exponents=tuple(int(getattr(base, name)) for name in base_units),
        factor=float(base.factor),
        offset=float(base.offset),
    )


def _variable(item: Any) -> Variable:  # noqa: ANN401 - fmpy carries no types
    def attribute(name: str) -> Any:  # noqa: ANN401 - fmpy carries no types
        value = getattr(item, name)
        if value is None and item.declaredType is not None:
            value = getattr(item.declaredType, name)
        return value

    nominal, low, high = attribute("nominal"), attribute("min"), attribute("max")
    return Variable(
        name=item.name,
        type=item.type,
        causality=item.causality,
        variability=item.variability,
        unit=attribute("unit"),
        nominal=None if nominal is None else abs(float(nominal)),
        minimum=-inf if low is None else float(low),
        maximum=inf if high is None else float(high),
        description=item.description or "",
    )
