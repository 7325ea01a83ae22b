"""The passage with contact on the track's side in other tools, at 100 us without iteration."""

import os

import pytest

pytestmark = [pytest.mark.host, pytest.mark.xdist_group("hosts")]  # they share what is built

JACOBI = 234_311.696
"""What all hosts must find that pass all outputs on, then step both FMUs [N]."""

QUICK = [
    ("fmpy", "native 2.0"),
    ("fmpy", "native 3.0"),
    ("libcosimpy", "native 2.0"),
    ("libcosimpy", "native 2.0, SSP"),
    ("ecospy", "native 2.0"),
    ("ecospy", "native 3.0"),
    ("ecospy", "native 2.0, SSP"),
    ("cofmupy", "native 2.0"),
    ("C program", "native 2.0"),
    ("C program", "native 3.0"),
]
SLOW = [
    ("cofmupy", "native 3.0"),
    ("C program, Windows", "native 2.0"),
    ("C program, Windows", "native 3.0"),
    ("fmpy", "python 2.0"),
    ("C program, LD_PRELOAD", "python 2.0"),
]
"""The Windows library takes minutes to compile for the first time; CoFmuPy and Python
FMUs take 10 to 20 s a run."""


def largest_force(row):
    """Run it; skip what is missing, unless the environment variable says that it must be there."""
    from host_tools.answer import HostError  # noqa: PLC0415 - importable by a fixture only

    try:
        return row.run().largest[0]
    except HostError as error:
        if not error.missing or os.environ.get("RAILCOSIM_HOSTS") == "required":
            raise
        pytest.skip(f"{row.host}: {error}")


@pytest.mark.parametrize(
    "case", [*QUICK, *(pytest.param(case, marks=pytest.mark.slow) for case in SLOW)], ids=" ".join
)
def test_the_peak_force_is_that_of_the_own_master(rows, own_peak, case):
    peak = largest_force(rows[case])
    assert own_peak == pytest.approx(234.4e3, rel=1e-3)
    assert peak == pytest.approx(own_peak, rel=5e-3)
    # all do the same sums, so that no more than rounding and the C library are between them
    assert peak == pytest.approx(JACOBI, rel=1e-8)


def test_every_row_is_tested(rows):
    assert set(rows) == {*QUICK, *SLOW}


def test_a_host_in_c_says_why_it_cannot_run(folder, monkeypatch):
    """Python FMUs without libpython: the message names what is missing."""
    from host_tools.answer import HostError  # noqa: PLC0415 - importable by a fixture only
    from host_tools.c_host import CHost, compile_host  # noqa: PLC0415 - as above
    from host_tools.systems import Systems  # noqa: PLC0415 - as above

    job = Systems(folder=folder).job("python 2.0")
    monkeypatch.delenv("LD_PRELOAD", raising=False)
    with pytest.raises(HostError, match="undefined symbol: _Py"):
        CHost(program=compile_host(folder)).run(job)
