"""System descriptions of the conformance FMUs, as text that a user would write."""

from html import escape

from tests.ssp import ssd_text as t


def component(name, source, inputs, outputs, **values):
    """A component with the parameter values given."""
    kinds = {bool: "Boolean", int: "Integer", float: "Real", str: "String"}
    items = [
        (key, f'<ssv:{kinds[type(value)]} value="{_text(value)}"/>')
        for key, value in values.items()
    ]
    inner = t.connectors(inputs=inputs, outputs=outputs)
    if items:
        inner += t.bindings(t.parameters(*items))
    return t.component(name, inner, source=source)


def _text(value):
    return str(value).lower() if isinstance(value, bool) else escape(str(value))


def link(source, target, factor=1.0):
    """A connection; `factor` is a transformation of the value on its way."""
    (start, output), (end, into) = source.split("."), target.split(".")
    return (
        f'<ssd:Connection startElement="{start}" startConnector="{output}" '
        f'endElement="{end}" endConnector="{into}">'
        f'<ssc:LinearTransformation factor="{factor}"/></ssd:Connection>'
    )


def system(components, links, *, stop, events=(), **settings):
    """A description that runs from 0 to `stop` [s] with the settings of the master given."""
    attributes = " ".join(f'{name}="{_text(value)}"' for name, value in settings.items())
    inner = "".join(f'<Event indicator="{event}"/>' for event in events)
    root = f'<ssd:DefaultExperiment startTime="0" stopTime="{stop}"/>'
    return t.ssd(components, "".join(links), root=root + t.master(attributes, inner))


def mass(name, source="mass.fmu", **values):
    """A mass that can carry the coupling to another one."""
    return component(
        name,
        source,
        ["force", "other_displacement", "other_velocity"],
        ["displacement", "velocity", "coupling_force"],
        **values,
    )


motion = (("displacement", "other_displacement"), ("velocity", "other_velocity"))


def oscillator(split, *, kc=100.0, dc=1.0, **settings):
    """Two masses of 1 kg on springs of 10 N/m, coupled; the first starts at 1 m.

    Parameters
    ----------
    split : {'force/displacement', 'displacement/displacement', 'force/force'}
        What the coupling's two sides get from each other: one carries the coupling and returns a
        force, both carry it, or none does and a third FMU returns forces to both.
    """
    coupling = {"coupling_stiffness": kc, "coupling_damping": dc}
    free, carrying = {"stiffness": 10.0}, {"stiffness": 10.0, **coupling}
    to_second = [link(f"first.{own}", f"second.{other}") for own, other in motion]
    if split == "force/displacement":
        components = [mass("first", start=1.0, **free), mass("second", **carrying)]
        links = [*to_second, link("second.coupling_force", "first.force")]
    elif split == "displacement/displacement":
        components = [mass("first", start=1.0, **carrying), mass("second", **carrying)]
        links = [*to_second, *(link(f"second.{own}", f"first.{other}") for own, other in motion)]
    else:
        spring = component(
            "spring",
            "spring.fmu",
            ["displacement", "velocity", "other_displacement", "other_velocity"],
            ["force"],
            stiffness=kc,
            damping=dc,
        )
        components = [mass("first", start=1.0, **free), mass("second", **free), spring]
        links = [
            *(link(f"first.{own}", f"spring.{own}") for own, _ in motion),
            *(link(f"second.{own}", f"spring.{other}") for own, other in motion),
            link("spring.force", "first.force"),
            link("spring.force", "second.force", factor=-1.0),
        ]
    return system(components, links, stop=2.0, **settings)


splits = ("force/displacement", "displacement/displacement", "force/force")


def relation(name, factor, amplitude=0.0):
    """A memoryless relation of its input and the time."""
    return component(name, "relation.fmu", ["u"], ["y"], factor=factor, amplitude=amplitude)


def loop(gain, **settings):
    """A spring k that is pushed by sin(t) and gives way to a compliance D, with k D = `gain`."""
    return system(
        [relation("spring", -gain, gain), relation("support", 1.0)],
        [link("spring.y", "support.u"), link("support.y", "spring.u")],
        stop=1.0,
        **settings,
    )


def decay(**values):
    """y' = -y from y = 1, where the FMU that integrates has the faults in `values`."""
    return system(
        [component("body", "faulty.fmu", ["u"], ["y"], **values), relation("law", -1.0)],
        [link("body.y", "law.u"), link("law.y", "body.u")],
        stop=1.0,
    )


def swinging(*, stiffness=100.0, source="ConformanceTrouble.fmu", behind=None, **values):
    """A mass of 1 kg on a spring, from 1 m; `behind` takes its displacement as a force."""
    components = [
        component("body", source, ["force"], ["x"], **values),
        relation("law", -stiffness),
    ]
    links = [link("body.x", "law.u"), link("law.y", "body.force")]
    if behind is not None:
        components.append(component("behind", behind, ["force"], ["x"]))
        links.append(link("body.x", "behind.force"))
    return system(components, links, stop=1.0)
