"""`railcosim cosim` and `railcosim check` with FMUs of FMI 2.0 and 3.0."""

import json
import shutil
from math import cos

import pytest
import ssd_text as t
from typer.testing import CliRunner

from railcosim import cli

stiffness = 25.0


@pytest.fixture
def mixed(compiled_fmu, tmp_path):
    """Two oscillators, a mass and a spring each: one FMU of each version in both."""
    for model in ("mass", "gain"):
        for version in (2, 3):
            shutil.copy(compiled_fmu(model, version), tmp_path / f"{model}{version}.fmu")
    spring = t.bindings(t.parameters(("gain", f'<ssv:Real value="{-stiffness}"/>')))
    components, links = [], ""
    for mass, gain in ((2, 3), (3, 2)):
        ends = t.connectors(inputs=["force"], outputs=["x"])
        components += [
            t.component(f"mass{mass}", ends, f"mass{mass}.fmu"),
            t.component(f"gain{gain}", t.connectors() + spring, f"gain{gain}.fmu"),
        ]
        links += (
            f'<ssd:Connection startElement="mass{mass}" startConnector="x"'
            f' endElement="gain{gain}" endConnector="u"/>'
            f'<ssd:Connection startElement="gain{gain}" startConnector="y"'
            f' endElement="mass{mass}" endConnector="force"/>'
        )
    path = tmp_path / "mixed.ssd"
    path.write_text(t.ssd(components, links), encoding="utf-8")
    return path


def final(path, step):
    arguments = ["cosim", str(path), "--stop-time", "1", "--step", str(step), "--json"]
    result = CliRunner().invoke(cli.app, arguments)
    assert (result.exit_code, result.stderr) == (0, "")
    return json.loads(result.stdout)["final"]


def test_both_versions_in_one_system_are_of_second_order(mixed):
    coarse, fine = final(mixed, 0.02), final(mixed, 0.01)
    for name in ("mass2.x", "mass3.x"):
        errors = [abs(ends[name] - cos(stiffness**0.5)) for ends in (coarse, fine)]
        # Halved steps leave a quarter of the error, but for terms of higher order.
        assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.02)
        assert errors[1] < 2e-3


def test_check_of_an_fmi3_fmu(compiled_fmu):
    result = CliRunner().invoke(cli.app, ["check", str(compiled_fmu("gain", 3)), "--json"])
    assert result.exit_code == 0, result.stderr
    assert {item["holds"] for item in json.loads(result.stdout).values()} == {True}
