"""Texts of system descriptions."""

spaces = " ".join(
    f'xmlns:{prefix}="http://ssp-standard.org/SSP1/SystemStructure{name}"'
    for prefix, name in (
        ("ssc", "Common"),
        ("ssd", "Description"),
        ("ssv", "ParameterValues"),
        ("ssm", "ParameterMapping"),
    )
)

connection = (
    '<ssd:Connection startElement="a" startConnector="y" endElement="b" endConnector="u"{more}>'
    "{inner}</ssd:Connection>"
)


plain = connection.format(more="", inner="")


def connectors(unit=None, inputs=("u",), outputs=("y",)):
    real = "<ssc:Real/>" if unit is None else f'<ssc:Real unit="{unit}"/>'
    listed = [(name, "input") for name in inputs] + [(name, "output") for name in outputs]
    inner = "".join(
        f'<ssd:Connector name="{n}" kind="{k}">{real}</ssd:Connector>' for n, k in listed
    )
    return f"<ssd:Connectors>{inner}</ssd:Connectors>"


def component(name, inner=None, source="relay.fmu", more=""):
    inner = connectors() if inner is None else inner
    return f'<ssd:Component name="{name}" source="{source}"{more}>{inner}</ssd:Component>'


def parameters(*items, more="", units=""):
    """One inline binding; items are (name, XML of the value)."""
    values = "".join(
        f'<ssv:Parameter name="{name}">{value}</ssv:Parameter>' for name, value in items
    )
    return (
        f"<ssd:ParameterBinding{more}><ssd:ParameterValues>"
        f'<ssv:ParameterSet version="1.0" name="p"><ssv:Parameters>{values}</ssv:Parameters>{units}'
        "</ssv:ParameterSet></ssd:ParameterValues></ssd:ParameterBinding>"
    )


def bindings(*texts):
    return f"<ssd:ParameterBindings>{''.join(texts)}</ssd:ParameterBindings>"


def ssd(
    components=None,
    links=plain,
    *,
    version="1.0",
    before="",
    after="",
    root="",
    head="",
):
    """The description of a system; by default relay `a` drives relay `b`."""
    components = components or [component("a"), component("b")]
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>{head}\n'
        f'<ssd:SystemStructureDescription {spaces} version="{version}" name="Test">'
        f'<ssd:System name="Root">{before}<ssd:Elements>{"".join(components)}</ssd:Elements>'
        f"<ssd:Connections>{links}</ssd:Connections>{after}</ssd:System>{root}"
        "</ssd:SystemStructureDescription>"
    )


experiment = '<ssd:DefaultExperiment startTime="0.5" stopTime="1.5"/>'


def master(attributes="", inner="", kind="org.railcosim.master"):
    return (
        f'<ssd:Annotations><ssc:Annotation type="{kind}">'
        f'<Master xmlns="urn:railcosim:master" {attributes}>{inner}</Master>'
        "</ssc:Annotation></ssd:Annotations>"
    )
