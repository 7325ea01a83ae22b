"""Saved states go elsewhere, and damaged ones are refused."""

import subprocess
import sys
from ctypes import byref
from pathlib import Path

from .fmi_calls import ERROR
from .fmi_inputs import INPUTS, OUTPUTS, STEP, both, both_versions, put_all, started

GO_ON = """
import sys
from pathlib import Path
sys.path.insert(0, {root!r})
from tests.native.fmi_calls import Calls, OK
instance = Calls({folder!r})
status, state = instance.deserialise(Path({data!r}).read_bytes())
assert status == OK, instance.messages
instance.must(instance.call("SetFMUstate", state))
for n in range(10, 20):
    instance.must(instance.step(n * 1e-4, 1e-4)[0])
print([value.hex() for value in instance.get(*{outputs!r})])
"""


@both_versions
@both
def test_a_serialised_state_goes_on_in_another_process(fmi, tmp_path, version, model):
    instance = started(fmi(version, model), model)
    for n in range(10):
        put_all(instance, INPUTS[model](n * STEP))
        instance.must(instance.step(n * STEP, STEP)[0])
    state = instance.save()
    (tmp_path / "state").write_bytes(instance.serialise(state))
    for n in range(10, 20):
        instance.must(instance.step(n * STEP, STEP)[0])
    script = GO_ON.format(
        root=str(Path(__file__).parents[2]),
        folder=str(instance.folder),
        data=str(tmp_path / "state"),
        outputs=OUTPUTS[model],
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == str([value.hex() for value in instance.get(*OUTPUTS[model])])
    instance.must(instance.call("FreeFMUstate", byref(state)))
    assert state.value is None


@both_versions
@both
def test_damaged_states_are_refused_in_words(fmi, version, model):
    instance = started(fmi(version, model), model)
    instance.must(instance.step(0.0, STEP)[0])
    data = instance.serialise(instance.save())
    before = instance.get(*OUTPUTS[model])
    places = {0, 4, 8, 12, 16, 40, len(data) // 2, len(data) - 1}
    for place in places:
        damaged = bytearray(data)
        damaged[place] ^= 0x10
        status, state = instance.deserialise(bytes(damaged))
        assert (status, state.value) == (ERROR, None)
        assert "state" in instance.messages.pop()[1]
    for size in (0, 1, 15, 16, 100, len(data) - 1):
        assert instance.deserialise(data[:size])[0] == ERROR
    assert instance.deserialise(data + b"x")[0] == ERROR
    assert instance.get(*OUTPUTS[model]) == before
    other = fmi(version, "vehicle" if model == "track" else "track")
    assert other.deserialise(data)[0] == ERROR
