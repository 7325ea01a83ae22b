"""Parameter bindings: values, prefixes, mappings, units and their order."""

import pytest
import ssd_text as t
from relay_fmu import with_units

from orchestrator import FmuError, SystemFileError, WiringError
from orchestrator.ssp import open_system

one_to_four = [(f"p{n}", f'<ssv:Real value="{n}"/>') for n in range(1, 5)]
centimetre = (
    '<ssv:Units><ssc:Unit name="cm"><ssc:BaseUnit m="1" factor="0.01"/></ssc:Unit></ssv:Units>'
)


def real(value, unit=None):
    return (
        f'<ssv:Real value="{value}"/>'
        if unit is None
        else f'<ssv:Real value="{value}" unit="{unit}"/>'
    )


def with_values(*texts, system="", source="relay.fmu"):
    inner = t.connectors() + t.bindings(*texts) if texts else t.connectors()
    return t.ssd([t.component("a", inner, source=source), t.component("b")], before=system)


def mapped(binding, mapping):
    """Add a mapping to a binding; (source, target, more attributes, transformation)."""
    entries = "".join(
        f'<ssm:MappingEntry source="{source}" target="{target}"{more}>{inner}</ssm:MappingEntry>'
        for source, target, more, inner in mapping
    )
    text = f'<ssm:ParameterMapping version="1.0">{entries}</ssm:ParameterMapping>'
    return binding.replace(
        "</ssd:ParameterBinding>",
        f"<ssd:ParameterMapping>{text}</ssd:ParameterMapping></ssd:ParameterBinding>",
    )


def test_values_of_every_type(put, histories):
    binding = t.parameters(
        ("start", real(2.5)),
        ("rate", '<ssv:Integer value="3"/>'),
        ("count", '<ssv:Integer value="4"/>'),
        ("flag", '<ssv:Boolean value="true"/>'),
        ("label", '<ssv:String value="name"/>'),
    )
    values = histories(put(with_values(binding)))
    assert values["a.y"].tolist() == [2.5, 3.25, 4.0, 4.75, 5.5]
    assert set(values["a.counted"]) == {8.0}
    assert set(values["a.raised"]) == {0.0}


def test_files_beside_the_description(put, histories):
    binding = t.parameters(("x", real(7.0)))
    inline = binding.partition("<ssd:ParameterValues>")[2].partition("</ssd:ParameterValues>")[0]
    put(inline.replace("<ssv:ParameterSet", f"<ssv:ParameterSet {t.spaces}"), "a value.ssv")
    put(
        f'<ssm:ParameterMapping {t.spaces} version="1.0"><ssm:MappingEntry source="x" '
        'target="start"/></ssm:ParameterMapping>',
        "names.ssm",
    )
    text = (
        '<ssd:ParameterBinding source="a%20value.ssv">'
        '<ssd:ParameterMapping source="names.ssm"/></ssd:ParameterBinding>'
    )
    assert histories(put(with_values(text)))["a.y"][0] == 7.0


def test_later_bindings_count_more_and_those_of_the_system_most(put, histories):
    own = [t.parameters(("start", real(1))), t.parameters(("start", real(2)), ("rate", real(0)))]
    system = t.bindings(t.parameters(("start", real(3)), more=' prefix="a."'))
    assert histories(put(with_values(*own)))["a.y"][0] == 2.0
    values = histories(put(with_values(*own, system=system)))
    assert values["a.y"].tolist() == [3.0] * 5
    assert values["b.y"][0] == 0.0


def test_a_mapping_names_and_transforms_and_leaves_the_rest_out(put, histories):
    mapping = [
        ("x.p1", "start", "", '<ssc:LinearTransformation factor="10" offset="1"/>'),
        ("x.p2", "rate", "", ""),
        ("x.p9", "count", "", ""),
    ]
    binding = mapped(t.parameters(*one_to_four, ("start", real(99)), more=' prefix="x."'), mapping)
    values = histories(put(with_values(binding)))
    assert values["a.y"].tolist() == [11.0, 11.5, 12.0, 12.5, 13.0]


@pytest.mark.parametrize(
    ("more", "change", "start"),
    [
        ("", "", 2.0),
        ("", '<ssc:LinearTransformation factor="3" offset="1"/>', 7.0),
        (' suppressUnitConversion="true"', "", 200.0),
    ],
)
def test_values_are_converted_to_the_unit_of_their_variable(
    relay, put, tmp_path, histories, more, change, start
):
    with_units(relay, tmp_path / "m.fmu", {"start": "m"})
    binding = t.parameters(("start", real(200, "cm")), units=centimetre)
    binding = mapped(binding, [("start", "start", more, change)])
    values = histories(put(with_values(binding, source="m.fmu")))
    assert values["a.y"][0] == pytest.approx(start, rel=4e-16)


def test_values_without_a_variable_are_passed_over_and_named(put):
    system = t.bindings(t.parameters(("a.stat", real(1)), ("c.start", real(1)), ("x", real(1))))
    text = with_values(t.parameters(("strat", real(1))), system=system)
    with open_system(put(text)) as opened:
        assert sorted(opened.unused) == ["a.stat", "a.strat", "c.start", "x"]


@pytest.mark.parametrize(
    ("binding", "error", "message"),
    [
        (t.parameters(("seen", real(1))), FmuError, "'seen' takes no start value"),
        (t.parameters(("count", real(1.5))), FmuError, "start value 1.5 of 'count'"),
        (t.parameters(("start", real("1 2"))), SystemFileError, "must be one finite number"),
        (t.parameters(("start", real("NaN"))), SystemFileError, "must be one finite number"),
        (
            t.parameters(("start", '<ssv:Enumeration value="red"/>')),
            SystemFileError,
            "parameters of this type are not supported",
        ),
        (t.parameters(("start", "")), SystemFileError, "it has 0 values but must have one"),
        (t.parameters(("start", real(1)), more=' type="text/csv"'), SystemFileError, "'text/csv'"),
        (t.parameters(("start", real(1)), more=' source="x.ssv"'), SystemFileError, "leave one"),
        ("<ssd:ParameterBinding/>", SystemFileError, "neither a source nor a content"),
        ('<ssd:ParameterBinding source="x.ssv"/>', SystemFileError, "'x.ssv' does not exist"),
        (
            mapped(t.parameters(*one_to_four), [("p1", "start", "", ""), ("p2", "start", "", "")]),
            SystemFileError,
            "'start' is the target of two entries",
        ),
        (
            mapped(
                t.parameters(("count", '<ssv:Integer value="3"/>')),
                [("count", "count", "", '<ssc:LinearTransformation factor="2"/>')],
            ),
            WiringError,
            "only Real values can be transformed",
        ),
    ],
)
def test_values_that_cannot_be_used_are_refused(put, binding, error, message):
    with pytest.raises(error) as caught, open_system(put(with_values(binding))):
        pass
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_value_in_a_unit_of_another_quantity_is_refused(relay, put, tmp_path):
    with_units(relay, tmp_path / "k.fmu", {"start": "K"})
    text = with_values(t.parameters(("start", real(1, "cm")), units=centimetre), source="k.fmu")
    with (
        pytest.raises(WiringError, match=r"^the value of a\.start: the units 'cm'"),
        open_system(put(text)),
    ):
        pass
