"""Types and arrays of FMI 3.0: every one of them, on an FMU in C."""

import logging
import zipfile

import numpy as np
import pytest
from compiled_fmus import integers
from fmu_driving import read, started

from orchestrator import (
    OK,
    FmuError,
    FmuParticipant,
)


def test_every_type_comes_back_as_it_was_set(compiled_fmu):
    limits = {name: (1 << (int(name.lstrip("UInt")) - (name[0] != "U"))) - 1 for name in integers}
    values = {f"p_{name}": limit for name, limit in limits.items()}
    signed = {f"p_{name}": -limits[name] - 1 for name in integers if name[0] != "U"}
    names = [f"o_{name}" for name in integers]
    for given in (values, {**values, **signed}):
        model = FmuParticipant(
            compiled_fmu("types", 3), start_values={**given, "flags[1]": True, "flags[2]": False}
        )
        started(model, observed=[*names, "mirror[1]", "mirror[2]"])
        try:
            expected = [float(given[f"p_{name}"]) for name in integers]
            assert read(model.get_observed, len(names) + 2) == [*expected, 0.0, 1.0]
        finally:
            model.free()


def test_elements_of_arrays_are_variables(compiled_fmu):
    """y = gain u, with one row changed and only the first and last element of u driven."""
    values = {"gain[2,1]": -4.0, "gain[2,3]": 0.5, "u[2]": 7.0}
    model = FmuParticipant(compiled_fmu("types", 3), start_values=values)
    assert model.dependencies["y[2]"] == frozenset({"u[1]", "u[2]", "u[3]"})
    assert model.dependencies["z"] == frozenset({"w"})
    started(model, inputs=["u[3]", "w", "u[1]"], outputs=["y[2]", "z", "y[1]"], observed=["u[2]"])
    try:
        assert model.set_inputs(np.array([100.0, 1.5, 2.0])) is OK
        assert model.step(0.0, 0.1) is OK
        u, gain = np.array([2.0, 7.0, 100.0]), np.array([[1.0, 2.0, 3.0], [-4.0, 5.0, 0.5]])
        y = gain @ u
        assert read(model.get_outputs, 3) == [y[1], 3.0, y[0]]
        assert read(model.get_observed, 1) == [7.0]
        out = np.full((3, 3), np.nan)
        assert model.directional_derivatives(out) is OK
        assert out.tolist() == [[0.5, 0.0, -4.0], [0.0, 2.0, 0.0], [3.0, 0.0, 1.0]]
    finally:
        model.free()


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"u": 1.0}, r"unknown variable 'u'; known are 'time', 'u\[1\]'"),
        ({"p_UInt8": 256}, r"256 of 'p_UInt8' lies outside \[0, 255\], which the type UInt8 can"),
        ({"p_Int16": -40000}, r"lies outside \[-32768, 32767\]"),
        ({"p_Int8": 1.5}, r"is of type float, but the variable is of type Integer"),
    ],
)
def test_start_values_of_fmi3_are_checked(compiled_fmu, values, message):
    with pytest.raises(FmuError, match=message):
        FmuParticipant(compiled_fmu("types", 3), start_values=values)


def changed(path, folder, old, new):
    """Copy an FMU with a part of its description replaced."""
    with zipfile.ZipFile(path) as source, zipfile.ZipFile(folder / "changed.fmu", "w") as target:
        for name in source.namelist():
            data = source.read(name)
            if name == "modelDescription.xml":
                assert old in data
                data = data.replace(old, new, 1)
            target.writestr(name, data)
    return folder / "changed.fmu"


def test_what_cannot_be_used_is_left_out_in_words(compiled_fmu, tmp_path, caplog):
    more = (
        b'<Binary name="blob" valueReference="90" causality="parameter" variability="fixed">'
        b'<Start value="00"/></Binary>'
        b'<Float64 name="huge" valueReference="91" causality="parameter" variability="fixed"'
        b' start="1"><Dimension start="101"/><Dimension start="100"/></Float64>'
    )
    old = b"</ModelVariables>"
    path = changed(compiled_fmu("types", 3), tmp_path, old, more + old)
    with pytest.raises(FmuError, match=r"'blob' takes no start value here, .* of type Binary, wh"):
        FmuParticipant(path, start_values={"blob": "00"})
    model = FmuParticipant(path, name="model")
    assert not {"blob", "huge[1,1]"} & set(model.variables)
    with caplog.at_level(logging.INFO, logger="orchestrator"):
        model.bind(inputs=[], outputs=[], observed=[], input_shape="held")
    assert "model.blob is left out, because it is of type Binary" in caplog.text
    assert "model.huge is left out, because it is an array of 10100 elements" in caplog.text


def test_a_size_that_a_parameter_gives_stays_as_it_is(compiled_fmu, tmp_path):
    """A structural parameter is known but cannot be set, and gives the start size of arrays."""
    path = changed(
        compiled_fmu("types", 3),
        tmp_path,
        b'<Dimension start="3"/>',
        b'<Dimension valueReference="95"/>',
    )
    parameter = (
        b'<UInt64 name="columns" valueReference="95" causality="structuralParameter"'
        b' variability="fixed" start="3"/></ModelVariables>'
    )
    (tmp_path / "again").mkdir()
    path = changed(path, tmp_path / "again", b"</ModelVariables>", parameter)
    assert "u[3]" in FmuParticipant(path).variables
    with pytest.raises(FmuError, match="because the sizes of arrays stay as they are"):
        FmuParticipant(path, start_values={"columns": 4})


def test_start_values_must_be_as_many_as_elements(compiled_fmu, tmp_path):
    path = changed(compiled_fmu("types", 3), tmp_path, b'"10 20 30"', b'"10 20"')
    with pytest.raises(FmuError, match=r"^changed\.fmu: 'u' has 3 elements, but 2 start values"):
        FmuParticipant(path)
