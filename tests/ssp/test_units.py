"""Units: what a conversion is, and that it arrives in the receiving FMU."""

import numpy as np
import pytest
import ssd_text as t
from relay_fmu import definitions, with_units

from orchestrator import (
    Connection,
    Linear,
    Master,
    MasterSettings,
    System,
    Unit,
    WiringError,
    convert,
)
from orchestrator.exchange import Exchange
from orchestrator.fmu import FmuParticipant
from orchestrator.ssp import open_system

metre = Unit(name="m", exponents=(0, 1, 0, 0, 0, 0, 0, 0))
kelvin = Unit(name="K", exponents=(0, 0, 0, 0, 1, 0, 0, 0))
celsius = Unit(name="degC", exponents=kelvin.exponents, offset=273.15)
fahrenheit = Unit(name="degF", exponents=kelvin.exponents, factor=5 / 9, offset=273.15 - 32 * 5 / 9)

pairs = [
    ("mm", "m", Linear(1e-3, 0.0)),
    ("m", "mm", Linear(1e3, 0.0)),
    ("km/h", "m/s", Linear(1.0 / 3.6, 0.0)),
    ("degC", "K", Linear(1.0, 273.15)),
    ("kN", "N", Linear(1e3, 0.0)),
]


def units_in_ssd(*names):
    inner = "".join(
        f'<ssc:Unit name="{n}"><ssc:BaseUnit {definitions[n]}/></ssc:Unit>' for n in names
    )
    return f"<ssd:Units>{inner}</ssd:Units>"


def test_a_conversion_goes_through_base_units():
    change = convert(fahrenheit, celsius)
    # Freezing and boiling point of water; the sums of offsets near 273 round at 1e-13.
    assert change(32.0) == pytest.approx(0.0, abs=1e-12)
    assert change(212.0) == pytest.approx(100.0, abs=1e-12)
    assert change.invert(100.0) == pytest.approx(212.0, abs=1e-12)
    assert convert(celsius, celsius) == Linear()


def test_different_quantities_are_not_converted():
    with pytest.raises(WiringError, match=r"'m' \(m\) and 'K' \(K\) do not measure the same thing"):
        convert(metre, kelvin)


@pytest.mark.parametrize("factor", [0.0, float("nan"), float("inf")])
def test_a_unit_has_a_sound_factor(factor):
    with pytest.raises(WiringError, match="must be finite and not zero"):
        Unit(name="x", factor=factor)


def test_maps_are_chained_in_their_order():
    assert Linear(2.0, 1.0).after(Linear(10.0, 3.0))(1.0) == 2.0 * (10.0 * 1.0 + 3.0) + 1.0


@pytest.mark.parametrize(("source", "target", "change"), pairs)
@pytest.mark.parametrize("by", ["fmu", "fmu and ssd", "ssd"])
def test_values_arrive_in_the_unit_of_the_receiver(
    relay, put, tmp_path, histories, source, target, change, by
):
    """Units of the FMUs defined by them or by the SSD, or units of connectors alone."""
    if by != "ssd":
        with_units(relay, tmp_path / "a.fmu", {"y": source}, defined=by == "fmu")
        with_units(relay, tmp_path / "b.fmu", {"u": target}, defined=by == "fmu")
        components = [t.component("a", source="a.fmu"), t.component("b", source="b.fmu")]
    else:
        components = [
            t.component("a", t.connectors(source)),
            t.component("b", t.connectors(target)),
        ]
    root = "" if by == "fmu" else units_in_ssd(source, target)
    values = histories(put(t.ssd(components, root=root)))
    # The rounding of one product and one sum.
    assert values["b.seen"] == pytest.approx(
        change.factor * values["a.y"] + change.offset, rel=4e-16
    )
    assert np.ptp(values["b.seen"]) > 0.0


def test_the_unit_of_a_connector_does_not_change_what_the_receiver_gets(
    relay, put, tmp_path, histories
):
    """A connector in mm on a variable in m: metres go in, metres come out."""
    with_units(relay, tmp_path / "a.fmu", {"y": "m"})
    with_units(relay, tmp_path / "b.fmu", {"u": "m"})
    components = [
        t.component("a", t.connectors("mm"), source="a.fmu"),
        t.component("b", t.connectors("mm"), source="b.fmu"),
    ]
    values = histories(put(t.ssd(components, root=units_in_ssd("mm"))))
    assert values["b.seen"].tobytes() == values["a.y"].tobytes()


@pytest.mark.parametrize(
    ("more", "inner", "change"),
    [
        ("", '<ssc:LinearTransformation factor="2" offset="5"/>', Linear(2e-3, 5.0)),
        (' suppressUnitConversion="true"', "", Linear()),
        (
            ' suppressUnitConversion="true"',
            '<ssc:LinearTransformation factor="2" offset="5"/>',
            Linear(2.0, 5.0),
        ),
    ],
)
def test_a_transformation_follows_the_conversion_or_replaces_it(
    relay, put, tmp_path, histories, more, inner, change
):
    with_units(relay, tmp_path / "a.fmu", {"y": "mm"})
    with_units(relay, tmp_path / "b.fmu", {"u": "m"})
    components = [t.component("a", source="a.fmu"), t.component("b", source="b.fmu")]
    values = histories(put(t.ssd(components, t.connection.format(more=more, inner=inner))))
    assert values["b.seen"] == pytest.approx(
        change.factor * values["a.y"] + change.offset, rel=4e-16
    )


@pytest.mark.parametrize(
    ("units", "root", "message"),
    [
        (("m", "K"), units_in_ssd("m", "K"), r"^a\.y -> b\.u: the units 'm' \(m\) and 'K'"),
        (("m", "mm"), units_in_ssd("m"), r"'m' and 'mm' differ, and 'mm' is not defined; define"),
    ],
)
def test_units_that_do_not_fit_are_refused(put, units, root, message):
    components = [
        t.component(name, t.connectors(unit)) for name, unit in zip("ab", units, strict=True)
    ]
    with pytest.raises(WiringError, match=message), open_system(put(t.ssd(components, root=root))):
        pass


def test_a_connector_of_another_quantity_than_its_variable_is_refused(relay, put, tmp_path):
    with_units(relay, tmp_path / "a.fmu", {"y": "m"})
    components = [t.component("a", t.connectors("K"), source="a.fmu"), t.component("b")]
    text = t.ssd(components, root=units_in_ssd("K"))
    with (
        pytest.raises(WiringError, match=r"^connector 'y' of a: the units 'm'"),
        open_system(put(text)),
    ):
        pass


def exchange(relay, conversion):
    masses = [FmuParticipant(relay, name=name) for name in "ab"]
    wire = Connection(source="a.y", target="b.u", conversion=conversion)
    return Exchange(System(masses, [wire]), indicators=[], observed=[], input_shape="held")


def test_an_identity_adds_nothing_to_the_calls(relay):
    for conversion in (None, Linear()):
        for stage in exchange(relay, conversion).stages:
            assert stage._set_inputs == stage.participant.set_inputs
            assert stage.converted_inputs() is stage.inputs
    _, receiver = exchange(relay, Linear(2.0)).stages
    assert receiver._set_inputs != receiver.participant.set_inputs


@pytest.mark.parametrize("factor", [0.0, float("nan")])
def test_a_conversion_that_loses_the_value_is_refused(relay, factor):
    with pytest.raises(WiringError, match=r"^a\.y -> b\.u: the factor .* must be finite"):
        exchange(relay, Linear(factor))


def test_unequal_units_need_a_conversion(relay, tmp_path):
    a = FmuParticipant(with_units(relay, tmp_path / "a.fmu", {"y": "mm"}), name="a")
    b = FmuParticipant(with_units(relay, tmp_path / "b.fmu", {"u": "m"}), name="b")
    with pytest.raises(WiringError, match="give both sides the same, or the connection a conv"):
        System([a, b], [Connection(source="a.y", target="b.u")])
    change = convert(a.units["mm"], b.units["m"])
    system = System([a, b], [Connection(source="a.y", target="b.u", conversion=change)])
    outcome = Master(system, MasterSettings(tolerance=None, fixed_step=0.5)).run(0.0, 1.0)
    assert outcome.finished
