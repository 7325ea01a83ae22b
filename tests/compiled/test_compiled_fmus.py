"""The FMUs in C keep to the standard and do what they say, driven by fmpy alone."""

import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

every_fmu = [
    *((model, version) for model in ("mass", "gain", "integrator") for version in (2, 3)),
    ("types", 3),
]


@pytest.mark.parametrize(("model", "fmi_version"), every_fmu)
def test_a_description_keeps_to_the_standard(compiled_fmu, model, fmi_version):
    assert validate_fmu(str(compiled_fmu(model, fmi_version))) == []


@pytest.mark.parametrize("fmi_version", [2, 3])
def test_the_mass_moves_exactly(compiled_fmu, fmi_version):
    history = simulate_fmu(
        str(compiled_fmu("mass", fmi_version)),
        fmi_type="CoSimulation",
        start_values={"force": 3.0, "mass": 2.0},
        output=["x", "v", "a"],
        stop_time=1.0,
        output_interval=0.125,
        use_event_mode=False,
    )
    assert len(history) == 9
    assert [history[name][-1] for name in "xva"] == pytest.approx([1.75, 1.5, 1.5], abs=1e-14)


@pytest.mark.parametrize("fmi_version", [2, 3])
def test_the_gain_has_no_memory(compiled_fmu, fmi_version):
    history = simulate_fmu(
        str(compiled_fmu("gain", fmi_version)),
        start_values={"u": 3.0, "gain": -0.5},
        output=["y"],
        stop_time=0.5,
        output_interval=0.25,
        use_event_mode=False,
    )
    assert history["y"].tolist() == [-1.5] * 3


@pytest.mark.parametrize("fmi_version", [2, 3])
def test_the_integrator_adds_up_its_input(compiled_fmu, fmi_version):
    history = simulate_fmu(
        str(compiled_fmu("integrator", fmi_version)),
        start_values={"u": 3.0, "rate": 2.0, "gain": -0.5, "start": 0.25},
        output=["y"],
        stop_time=0.5,
        output_interval=0.25,
        use_event_mode=False,
    )
    assert history["y"].tolist() == [0.25, 0.25, 1.75]
