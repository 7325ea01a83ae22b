"""Opening an FMU file: is it one, is it one the master can drive, and what does it contain."""

import zipfile
import zlib
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import fmpy
from fmpy.model_description import ValidationError, read_model_description
from lxml import etree

from ..archives import find_danger
from ..errors import FmuError
from ..units import Unit, base_units
from .description import FmuDescription
from .variables import dependencies, read_variables


class Model(NamedTuple):
    """A model description as fmpy reads it, and a claim that it overlooks.

    Attributes
    ----------
    content : object
        The description.
    provides_directional_derivatives : bool
        FMI 3.0 spells the attribute in the plural, where fmpy looks for the singular.
    """

    content: Any
    provides_directional_derivatives: bool


def read_fmu(path: Path) -> FmuDescription:
    """Read and check the FMU at `path`.

    Raises
    ------
    FmuError
        When the file is missing, no zip archive, has no valid model description, is of another FMI
        version or kind, or has no binary for this platform.
    """
    model, provides_directional_derivatives = _read_model(path)
    if model.fmiVersion != "2.0" and not model.fmiVersion.startswith("3."):
        raise FmuError(
            f"{path.name}: the FMU is of FMI version {model.fmiVersion}, but only 2.0 and 3.0 can "
            "be used."
        )
    if model.coSimulation is None:
        kind = "model exchange" if model.modelExchange else "scheduled execution"
        raise FmuError(f"{path.name}: the FMU is for {kind} only; export it for co-simulation.")
    platforms = fmpy.supported_platforms(path)
    if fmpy.platform not in platforms:
        raise FmuError(
            f"{path.name}: the FMU has no binary for {fmpy.platform}, "
            f"only for {', '.join(platforms) or 'no platform at all'}."
        )
    interface = model.coSimulation
    found = read_variables(path.name, model)
    return FmuDescription(
        path=path,
        fmi_version=2 if model.fmiVersion == "2.0" else 3,
        model_name=model.modelName,
        model_identifier=interface.modelIdentifier,
        guid=model.guid,
        can_save_state=bool(interface.canGetAndSetFMUstate),
        can_serialise_state=bool(interface.canSerializeFMUstate),
        can_vary_step=bool(interface.canHandleVariableCommunicationStepSize),
        can_interpolate_inputs=bool(interface.canInterpolateInputs),
        provides_directional_derivatives=provides_directional_derivatives,
        dependencies=dependencies(model, model.outputs, found),
        initial_dependencies=dependencies(model, model.initialUnknowns, found),
        variables=found.variables,
        storage=found.storage,
        array_starts=found.array_starts,
        settable=frozenset(found.settable),
        left_out=found.left_out,
        units={
            item.name: _unit(item) for item in model.unitDefinitions if item.baseUnit is not None
        },
    )


def _read_model(path: Path) -> Model:
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


def _parse(file: str, description: str) -> Model:
    if b"<!DOCTYPE" in Path(description).read_bytes():
        raise FmuError(
            f"{file}: a document type with its entities is refused in the model description."
        )
    try:
        content = read_model_description(description, validate=True)
    except ValidationError as error:
        problem = " ".join(str(error.problems[0]).split())
        raise FmuError(f"{file}: the model description is not valid: {problem}") from error
    except Exception as error:  # fmpy raises plain Exception, lxml its own kinds
        problem = " ".join(str(error).split())
        raise FmuError(f"{file}: the model description cannot be read: {problem}") from error
    interface = etree.parse(description).find("CoSimulation")
    claims = {} if interface is None else interface.attrib
    names = ("providesDirectionalDerivative", "providesDirectionalDerivatives")
    return Model(content, any(claims.get(name) in {"true", "1"} for name in names))


def _unit(item: Any) -> Unit:  # noqa: ANN401 - fmpy carries no types
    base = item.baseUnit
    return Unit(
        name=item.name,
        exponents=tuple(int(getattr(base, name)) for name in base_units),
        factor=float(base.factor),
        offset=float(base.offset),
    )
