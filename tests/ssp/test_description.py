"""Reading descriptions of SSP 1.0 and 2.0: what they mean, and what is refused."""

import zipfile
from pathlib import Path

import fmpy.ssp
import pytest
import ssd_text as t
from lxml import etree

from orchestrator import Linear, MasterSettings, SystemFileError, Unit, WiringError
from orchestrator.ssp import (
    Component,
    Connector,
    Link,
    MappingEntry,
    MasterChoices,
    ParameterBinding,
    ParameterValue,
    SystemDescription,
    annotation_type,
    open_system,
    write_description,
)
from orchestrator.ssp.files import Folder
from orchestrator.ssp.reading import read_description


def read(path):
    return read_description(path, Folder(path=path.parent, is_closed=False))


def refused(path, error=SystemFileError):
    """Give the sentence with which a file is refused."""
    with pytest.raises(error) as caught, open_system(path):
        pass
    sentence = str(caught.value)
    assert sentence.endswith(".")
    assert "\n" not in sentence
    return sentence


def test_a_1_0_description(put, histories):
    path = put(t.ssd(root=t.experiment))
    description = read(path)
    assert description.name == "Test"
    assert (description.start_time, description.stop_time) == (0.5, 1.5)
    assert [item.name for item in description.components] == ["a", "b"]
    assert description.links == (Link(start=("a", "y"), end=("b", "u")),)
    values = histories(path)
    assert values["b.seen"].tobytes() == values["a.y"].tobytes()


def test_a_2_0_description(put, histories):
    """Types of FMI 3.0, meta data, and a connector that is not connected."""
    more = (
        '<ssd:Connectors><ssd:Connector name="u" kind="input"><ssc:Float64/></ssd:Connector>'
        '<ssd:Connector name="y" kind="output"><ssc:Float64/></ssd:Connector>'
        '<ssd:Connector name="counted" kind="output"><ssc:Int32/></ssd:Connector>'
        "</ssd:Connectors>"
        + t.bindings(t.parameters(("count", '<ssv:Int32 value="3"/>')))
        + '<ssc:MetaData kind="general" type="text/plain"><ssc:Content>x</ssc:Content>'
        + "</ssc:MetaData>"
    )
    text = t.ssd([t.component("a", more), t.component("b")], version="2.0")
    values = histories(put(text))
    assert values["b.seen"].tobytes() == values["a.y"].tobytes()
    assert set(values["a.counted"]) == {6.0}


def test_start_and_end_say_nothing_about_the_direction(put, histories):
    link = '<ssd:Connection startElement="b" startConnector="u" endElement="a" endConnector="y"/>'
    values = histories(put(t.ssd(links=link)))
    assert values["b.seen"].tobytes() == values["a.y"].tobytes()


def test_what_a_system_shows_to_the_outside_changes_nothing(put, histories):
    shown = '<ssd:Connectors><ssd:Connector name="out" kind="output"/></ssd:Connectors>'
    links = t.plain + '<ssd:Connection startElement="a" startConnector="y" endConnector="out"/>'
    values = histories(put(t.ssd(before=shown, links=links)))
    assert values["b.seen"].tobytes() == values["a.y"].tobytes()


def test_what_is_for_drawings_and_other_tools_is_passed_over(put):
    geometry = '<ssd:ElementGeometry x1="0" y1="0" x2="1" y2="1"/>'
    other = (
        '<ssd:Annotations><ssc:Annotation type="com.example.tool"><x xmlns="urn:x" a="1"/>'
        "</ssc:Annotation></ssd:Annotations>"
    )
    inner = '<ssd:ConnectionGeometry pointsX="0" pointsY="0"/>' + other
    text = t.ssd(
        [t.component("a", t.connectors() + geometry + other), t.component("b")],
        t.connection.format(more=' description="x"', inner=inner),
        after='<ssd:SystemGeometry x1="0" y1="0" x2="1" y2="1"/>' + other,
        root=other,
    )
    assert len(read(put(text)).links) == 1


everything = SystemDescription(
    name="Round & trip",
    components=(
        Component(
            name="a",
            source="resources/a b.fmu",
            connectors=(
                Connector(name="u", kind="input", type="Real", unit="mm"),
                Connector(name="y[1]", kind="output"),
            ),
            bindings=(
                ParameterBinding(
                    prefix="p.",
                    values=(
                        ParameterValue(name="x", value=0.1 + 0.2, unit="cm"),
                        ParameterValue(name="n", value=-3),
                        ParameterValue(name="f", value=True),
                        ParameterValue(name="s", value=' <"&> '),
                    ),
                    mapping=(
                        MappingEntry(
                            source="p.x",
                            target="start",
                            transformation=Linear(2.0, 1e-300),
                            converts_units=False,
                        ),
                    ),
                    units={"cm": Unit(name="cm", exponents=(0, 1) + (0,) * 6, factor=1e-2)},
                ),
            ),
        ),
        Component(name="b", source="resources/a b.fmu"),
    ),
    links=(
        Link(
            start=("a", "y[1]"),
            end=("b", "u"),
            transformation=Linear(1 / 3, -2.5),
            converts_units=False,
        ),
    ),
    bindings=(ParameterBinding(values=(ParameterValue(name="b.x", value=1e22),)),),
    units={"mm": Unit(name="mm", exponents=(0, 1) + (0,) * 6, factor=1e-3, offset=0.5)},
    start_time=0.1,
    stop_time=0.7,
    master=MasterChoices(
        settings={
            "algorithm": "jacobi",
            "tolerance": 1e-3,
            "max_rejections": 7,
            "extrapolate": False,
        },
        bonds=(("a.y", "b.seen"), ("b.seen", "a.y")),
        events=("a.y[1]",),
    ),
)


@pytest.mark.parametrize("description", [everything, SystemDescription(name="", components=())])
def test_what_is_written_is_read_again(description, tmp_path):
    (tmp_path / "resources").mkdir()
    (tmp_path / "resources" / "a b.fmu").touch()
    path = tmp_path / "system.ssd"
    path.write_bytes(write_description(description))
    assert read(path) == description
    assert write_description(read(path)) == path.read_bytes()


def test_what_is_written_is_valid_ssp_1_0():
    schemas = Path(fmpy.ssp.__file__).parent / "schema"
    schema = etree.XMLSchema(file=str(schemas / "SystemStructureDescription.xsd"))
    schema.assertValid(etree.fromstring(write_description(everything)))


twice = t.connectors(inputs=("u", "u"))
table = (
    '<ssc:BooleanMappingTransformation><ssc:MapEntry source="0" target="1"/>'
    "</ssc:BooleanMappingTransformation>"
)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (t.ssd(version="3.0"), "version '3.0' is not supported"),
        (t.ssd(root="<ssd:Secret/>"), "ssd:Secret: it is not supported here"),
        (t.ssd(after="<other xmlns='urn:x'/>"), "urn:x:other: it is not supported here"),
        (t.ssd(after='<ssd:SimulationInformation xmlns:ssd="x"/>'), "not supported here"),
        (t.ssd([t.component("a", more=' speed="2"')]), "attribute 'speed' is not supported"),
        (t.ssd(["<ssd:System name='in'/>"]), "a system within a system is not supported"),
        (
            t.ssd(["<ssd:SignalDictionaryReference name='d' dictionary='d'/>"]),
            "signal dictionaries are not supported",
        ),
        (t.ssd([t.component("a", more=' type="application/x-ssp-package"')]), "only FMUs"),
        (t.ssd([t.component("a", more=' implementation="ModelExchange"')]), "'CoSimulation' is"),
        (t.ssd([t.component("a", source="no.fmu")]), "the source 'no.fmu' does not exist"),
        (t.ssd([t.component("a", source="http://x/y.fmu")]), "must be a file relative to"),
        (t.ssd([t.component("a", source="/etc/passwd")]), "must be a file relative to"),
        (t.ssd([t.component("a", twice)]), "there are two connectors 'u'"),
        (
            t.ssd(
                [
                    t.component(
                        "a",
                        "<ssd:Connectors><ssd:Connector name='u' kind='input'>"
                        "<ssc:Real/><ssc:Dimension size='3'/></ssd:Connector></ssd:Connectors>",
                    )
                ]
            ),
            "connectors of clocks, binary data and arrays are not supported",
        ),
        (t.ssd(links=t.connection.format(more="", inner=table)), "only linear transformations"),
        (
            t.ssd(
                links=t.connection.format(more="", inner='<ssc:LinearTransformation factor="0"/>')
            ),
            "factor is 0, which loses the value",
        ),
        (
            t.ssd(
                links=t.connection.format(more="", inner='<ssc:LinearTransformation factor="1 2"/>')
            ),
            "factor is '1 2' but must be one finite number",
        ),
        (
            t.ssd(links=t.connection.format(more=' suppressUnitConversion="maybe"', inner="")),
            "suppressUnitConversion is 'maybe' but must be true or false",
        ),
        (t.ssd(links=t.connection.format(more=' startIndices="1"', inner="")), "array elements"),
        (
            t.ssd(links='<ssd:Connection startConnector="x" endElement="b" endConnector="u"/>'),
            "a system has no surroundings here",
        ),
        (
            t.ssd(links='<ssd:Connection startElement="a" endElement="b" endConnector="u"/>'),
            "the attribute 'startConnector' is missing",
        ),
        (t.ssd(root='<ssd:DefaultExperiment stopTime="soon"/>'), "stopTime is 'soon' but must be"),
        (t.ssd(root='<ssd:DefaultExperiment stopTime="INF"/>'), "stopTime is 'INF' but must be"),
        ("<a/>", "the root element must be ssd:SystemStructureDescription"),
        (t.ssd()[:-9], "the XML is not well-formed"),
        ("", "the XML is not well-formed"),
    ],
)
def test_what_is_not_understood_is_refused(put, text, message):
    sentence = refused(put(text))
    assert sentence.startswith("system.ssd")
    assert message in sentence


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (t.ssd([t.component(name) for name in "aab"]), "2 participants are called 'a'"),
        (t.ssd([t.component("a"), t.component("c")]), "ends at 'b', which is no component"),
        (
            t.ssd([t.component("a"), t.component("b", t.connectors(inputs=()))]),
            "b has no connector 'u'",
        ),
        (
            t.ssd([t.component("a"), t.component("b", t.connectors(inputs=("u", "v")))]),
            "connector 'v' of b: the FMU has no such variable",
        ),
        (
            t.ssd([t.component("a"), t.component("b", t.connectors(inputs=("u", "seen")))]),
            "it is of the kind 'input', but the variable of the FMU is of the causality 'output'",
        ),
        (
            t.ssd([t.component("a"), t.component("b", t.connectors(outputs=("counted",)))]),
            "it is of the type Real, but the variable of the FMU is of the type Integer",
        ),
        (
            t.ssd(links=t.plain.replace('"u"', '"y"')),
            "a connection joins an output and an input, but these are of the kinds 'output' and",
        ),
    ],
)
def test_what_does_not_fit_the_fmus_is_refused(put, text, message):
    assert message in refused(put(text), WiringError)


def test_the_annotation_of_the_master(put):
    inner = '<Event indicator="a.y"/><Event indicator="b.seen"/>'
    attributes = 'algorithm="jacobi" tolerance="1e-5" max_iterations="9" extrapolate="false"'
    choices = read(put(t.ssd(root=t.master(attributes, inner)))).master
    assert choices.settings == {
        "algorithm": "jacobi",
        "tolerance": 1e-5,
        "max_iterations": 9,
        "extrapolate": False,
    }
    assert choices.events == ("a.y", "b.seen")
    assert read(put(t.ssd())).master == MasterChoices()


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        ({"root": t.master('tolerence="1"')}, "perhaps 'tolerance' or"),
        ({"root": t.master('tolerance="small"')}, "tolerance is 'small' but must be one finite"),
        ({"root": t.master('max_iterations="1.5"')}, "must be one whole number"),
        ({"root": t.master('extrapolate="no"')}, "must be true or false"),
        ({"root": t.master(inner="<Evnt/>")}, "master:Evnt: it is not supported here"),
        ({"root": t.master(kind="org.railcosim.mastre")}, "perhaps 'org.railcosim.master'"),
        ({"after": t.master('tolerance="1"')}, "belongs into ssd:Annotations of"),
        (
            {"root": t.master().replace("Master xmlns", "Boss xmlns").replace("/Master", "/Boss")},
            "master:Boss: it is not supported here",
        ),
    ],
)
def test_an_annotation_that_is_wrong_or_in_the_wrong_place_is_refused(put, parts, message):
    assert message in refused(put(t.ssd(**parts)))


def test_the_type_of_the_annotation_is_the_documented_one():
    assert annotation_type == "org.railcosim.master"


def test_only_the_default_variant_of_an_archive_is_read(relay, tmp_path, histories):
    path = tmp_path / "system.ssp"
    with zipfile.ZipFile(path, "w") as archive:
        archive.write(relay, "resources/relay.fmu")
        inside = [t.component(name, source="resources/relay.fmu") for name in "ab"]
        archive.writestr("SystemStructure.ssd", t.ssd(inside))
        archive.writestr("Other.ssd", "not even XML")
    values = histories(path)
    assert values["b.seen"].tobytes() == values["a.y"].tobytes()


def test_the_example_of_the_documentation_is_understood(tmp_path):
    text = (Path(__file__).parents[2] / "docs" / "cosim.md").read_text(encoding="utf-8")
    example = text.partition("```xml\n")[2].partition("```")[0]
    for name in ("Ball.fmu", "Spring.fmu"):
        (tmp_path / name).touch()
    path = tmp_path / "example.ssd"
    path.write_text(example, encoding="utf-8")
    description = read(path)
    assert description.links[1].transformation == Linear(-1.0, 0.0)
    assert description.master.settings["max_step"] == 1e-2
    assert description.master.events == ("ball.displacement",)
    MasterSettings(**description.master.settings)
