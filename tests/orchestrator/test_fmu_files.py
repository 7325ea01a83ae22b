"""Files and start values that are refused, each with one clear sentence."""

import zipfile
from pathlib import Path

import pytest

from orchestrator import (
    FmuError,
    FmuParticipant,
    Master,
    MasterSettings,
    ParticipantError,
    System,
)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"mas": 1.0}, r"start value for the unknown variable 'mas'; perhaps 'mass' is meant\.$"),
        ({"x": 1.0}, r"'x' takes no start value, because the FMU calculates it"),
        ({"mass": "heavy"}, r"start value 'heavy' of 'mass' is of type str, .* of type Real\.$"),
        ({"mass": True}, r"start value True of 'mass' is of type bool"),
        ({"trouble": 1.5}, r"start value 1\.5 of 'trouble' is of type float, .* Integer"),
        ({"linear_inputs": 1}, r"start value 1 of 'linear_inputs' is of type int, .* Boolean"),
        ({"label": 1}, r"start value 1 of 'label' is of type int, .* String"),
    ],
)
def test_start_values_are_checked(fmu, values, message):
    with pytest.raises(FmuError, match=rf"^OrchestratorTestMass\.fmu: {message}"):
        FmuParticipant(fmu, start_values=values)


def test_a_missing_file_is_said_so(tmp_path):
    with pytest.raises(FmuError, match=r"nothing\.fmu: there is no such FMU file\.$"):
        FmuParticipant(tmp_path / "nothing.fmu")


def test_a_file_that_is_no_archive_is_said_so(tmp_path):
    path = tmp_path / "text.fmu"
    path.write_text("not an FMU")
    with pytest.raises(
        FmuError, match=r"^text\.fmu: the file is no FMU, because it is no intact zip"
    ):
        FmuParticipant(path)


def rewritten(fmu, path, change):
    """Copy an FMU with every member replaced by change(name, data), or left out if that is None."""
    with zipfile.ZipFile(fmu) as source, zipfile.ZipFile(path, "w") as target:
        for name in source.namelist():
            data = change(name, source.read(name))
            if data is not None:
                target.writestr(name, data)
    return path


def in_description(old, new):
    def change(name, data):
        return data.replace(old, new) if name == "modelDescription.xml" else data

    return change


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda name, data: None if name == "modelDescription.xml" else data,
            "holds no modelDescription.xml",
        ),
        (
            lambda name, data: data[:300] if name == "modelDescription.xml" else data,
            "the model description cannot be read: ",
        ),
        (in_description(b'fmiVersion="2.0"', b'fmiVersion="4.0"'), "Unsupported FMI version: 4.0"),
        (in_description(b"causality=", b"casuality="), "the model description is not valid: "),
        (in_description(b"CoSimulation", b"ModelExchange"), "not valid: "),
        (
            in_description(b"<Real", b'<Real min="2" max="1"'),
            r"force: minimum 2\.0 must not exceed maximum 1\.0\.",
        ),
        (
            lambda name, data: None if name.startswith("binaries/") else data,
            "has no binary for .*, only for no platform at all",
        ),
    ],
)
def test_unusable_fmus_are_refused_in_one_sentence(fmu, tmp_path, change, message):
    path = rewritten(fmu, tmp_path / "unusable.fmu", change)
    with pytest.raises(FmuError, match=rf"^unusable\.fmu: .*{message}") as caught:
        FmuParticipant(path)
    assert "\n" not in str(caught.value)


def test_a_library_that_cannot_be_loaded_is_named(fmu, tmp_path, unpacked):
    path = rewritten(
        fmu,
        tmp_path / "empty.fmu",
        lambda name, data: b"nothing" if name.startswith("binaries/") else data,
    )
    mass = FmuParticipant(path, name="mass")
    here = Path.cwd()
    with pytest.raises(ParticipantError, match=r"^mass: it could not be loaded \(.*\)\.$"):
        Master(System([mass], []), MasterSettings(tolerance=1e-3)).run(0.0, 1.0)
    assert list(unpacked.iterdir()) == []
    assert Path.cwd() == here
