import pytest

from orchestrator.ssp import MasterChoices, SystemDescription
from railcosim.cosim_options import DEFAULT_TOLERANCE, CosimOptions
from railcosim.errors import InputError


def settings(options, **choices):
    return CosimOptions(**options).settings(MasterChoices(settings=choices))


def test_without_a_word_there_is_error_control():
    chosen = settings({})
    assert (chosen.tolerance, chosen.fixed_step) == (DEFAULT_TOLERANCE, None)
    assert chosen.algorithm == "newton"


def test_the_file_decides_what_the_command_line_leaves_open():
    chosen = settings({"algorithm": "jacobi"}, tolerance=1e-2, max_step=1.0, algorithm="newton")
    assert (chosen.tolerance, chosen.max_step, chosen.algorithm) == (1e-2, 1.0, "jacobi")


def test_a_fixed_step_replaces_error_control_with_all_that_belongs_to_it():
    chosen = settings({"step": 0.1}, tolerance=1e-2, max_step=0.01, min_step=1e-3)
    assert (chosen.fixed_step, chosen.tolerance) == (0.1, None)
    assert (chosen.max_step, chosen.min_step) == (None, None)
    assert settings({"step": 0.1, "tolerance": 1e-5}).tolerance == 1e-5
    assert settings({"step": 0.1, "min_step": 1e-3}).min_step == 1e-3


@pytest.mark.parametrize("options", [{"tolerance": 1e-3}, {"max_step": 0.5}])
def test_error_control_replaces_a_fixed_step(options):
    chosen = settings(options, fixed_step=0.1, min_step=1e-3)
    assert (chosen.fixed_step, chosen.min_step) == (None, None)
    assert chosen.tolerance == options.get("tolerance", DEFAULT_TOLERANCE)


@pytest.mark.parametrize("options", [{"max_step": 1e-4}, {"min_step": 0.05}])
def test_new_limits_of_the_step_fit_a_first_step_that_the_file_gives(options):
    chosen = settings(options, tolerance=1e-3, initial_step=1e-2)
    control = chosen.make_controller(1.0)
    assert control.min_step <= control.first_step


def test_the_span_is_that_of_the_file_or_the_command_line():
    description = SystemDescription(name="x", components=(), start_time=1.0, stop_time=2.0)
    assert CosimOptions().span(description) == (1.0, 2.0)
    assert CosimOptions(stop_time=3.0).span(description) == (1.0, 3.0)
    with pytest.raises(InputError, match="later than the start time, 1 s"):
        CosimOptions(stop_time=1.0).span(description)
    with pytest.raises(InputError, match="does not say when to stop"):
        CosimOptions().span(SystemDescription(name="x", components=()))
