"""What the FMUs say about themselves, and that builds are reproducible."""

import zipfile

import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu
from lxml import etree

from fmu_src.building import ensure_fmus
from fmu_src.structure import Structure
from orchestrator import FmuParticipant


def descriptions(fmus):
    return [read_model_description(str(path)) for path in (fmus.track, fmus.vehicle)]


def test_fmpy_finds_nothing_wrong(fmus, small_fmus):
    for paths in (fmus, small_fmus):
        assert validate_fmu(str(paths.track)) == []
        assert validate_fmu(str(paths.vehicle)) == []


def test_every_variable_has_a_description_and_every_quantity_a_unit(fmus):
    for description in descriptions(fmus):
        for variable in description.modelVariables:
            assert len(variable.description) > 10, variable.name
            if variable.type == "Real":
                assert variable.unit, variable.name
            if variable.causality in {"input", "output"} and variable.type == "Real":
                assert variable.nominal is not None, variable.name
                if "position" not in variable.name:
                    assert "positive" in variable.description, variable.name


def test_connected_variables_agree_in_unit_and_nominal(fmus):
    track, vehicle = ({v.name: v for v in d.modelVariables} for d in descriptions(fmus))
    for wheel in (1, 2):
        for quantity in ("position", "contact_force", "rail_displacement"):
            name = f"wheel[{wheel}].{quantity}"
            assert track[name].unit == vehicle[name].unit
            assert track[name].nominal == vehicle[name].nominal
            assert {track[name].causality, vehicle[name].causality} == {"input", "output"}
    assert float(track["wheel[1].contact_force"].min) == 0.0
    assert float(track["wheel[1].contact_force"].nominal) == 1e5


def test_connected_as_they_are_they_begin_alike(fmus):
    """Place, load and speed of the wheels: else the static start is none of this vehicle."""
    track, vehicle = ({v.name: v.start for v in d.modelVariables} for d in descriptions(fmus))
    assert track["initial_speed"] == vehicle["speed"]
    assert track["wheel[1].position"] == vehicle["initial_position"]
    assert track["wheel[1].contact_force"] == vehicle["static_wheel_load"]
    behind = float(track["wheel[1].position"]) - float(track["wheel[2].position"])
    assert behind == pytest.approx(float(vehicle["wheel[2].offset"]), abs=1e-12)


def test_outputs_depend_on_inputs_through_steps_only(fmus):
    """At a communication point nothing feeds through; during initialisation the statics do."""
    for path in (fmus.track, fmus.vehicle):
        with zipfile.ZipFile(path) as archive:
            root = etree.fromstring(archive.read("modelDescription.xml"))
        names = [v.get("name") for v in root.find("ModelVariables")]
        outputs = root.findall("ModelStructure/Outputs/Unknown")
        assert outputs
        assert all(unknown.get("dependencies") == "" for unknown in outputs)
        initial = {
            names[int(unknown.get("index")) - 1]: {
                names[int(i) - 1] for i in unknown.get("dependencies").split()
            }
            for unknown in root.findall("ModelStructure/InitialUnknowns/Unknown")
        }
        if path == fmus.track:
            assert "wheel[2].contact_force" in initial["wheel[1].rail_displacement"]
        else:
            assert initial["wheel[1].contact_force"] == set()
            assert initial["wheel[1].displacement"] == {"wheel[1].rail_displacement"}
        participant = FmuParticipant(path)
        assert participant.dependencies[names[int(outputs[0].get("index")) - 1]] == frozenset()
        for name, known in initial.items():
            inputs = {item for item in known if participant.variables[item].causality == "input"}
            assert participant.initial_dependencies[name] == inputs


def test_capabilities_are_declared(fmus):
    for description in descriptions(fmus):
        simulation = description.coSimulation
        assert simulation.canGetAndSetFMUstate
        assert simulation.canSerializeFMUstate
        assert simulation.canHandleVariableCommunicationStepSize
        assert not simulation.needsExecutionTool


def test_the_same_input_gives_the_same_bytes(fmus, tmp_path):
    again = ensure_fmus(tmp_path)
    assert again.track.read_bytes() == fmus.track.read_bytes()
    assert again.vehicle.read_bytes() == fmus.vehicle.read_bytes()


def test_what_is_up_to_date_is_left_alone_and_what_is_damaged_is_built_again(tmp_path):
    structure = Structure(bays=6, elements_per_bay=2, wheels=1, gauges=0)
    built = []
    paths = ensure_fmus(tmp_path, structure, progress=built.append)
    assert len(built) == 2
    before = paths.track.stat().st_mtime_ns
    ensure_fmus(tmp_path, structure, progress=built.append)
    assert len(built) == 2
    assert paths.track.stat().st_mtime_ns == before
    sound = paths.track.read_bytes()
    paths.track.write_bytes(sound[: len(sound) // 2])
    ensure_fmus(tmp_path, structure, progress=built.append)
    assert built[2:] == [f"building {paths.track.name}"]
    assert paths.track.read_bytes() == sound


def test_structures_have_their_own_files():
    default, other = Structure(), Structure(bays=60, wheels=4)
    assert default.file_name("track") == "Track.fmu"
    assert other.file_name("track") == "Track-60bays-4wheels.fmu"
    assert other.file_name("vehicle") == "Vehicle-4wheels.fmu"


@pytest.mark.parametrize("values", [{"bays": 1}, {"wheels": 0}, {"gauges": -1}])
def test_impossible_structures_are_refused(values):
    with pytest.raises(ValueError, match=f"{next(iter(values))} is"):
        Structure(**values)
