"""Settings of the master in an annotation of a system description."""

from dataclasses import fields

from ..errors import close_matches
from ..settings import MasterSettings, counts
from .description import MasterChoices, SettingValue
from .documents import Element

annotation_type = "org.railcosim.master"
"""Type of the annotation."""

setting_names = tuple(item.name for item in fields(MasterSettings))
"""Attributes that the element ``master:Master`` may have."""

_truths = ("extrapolate", "check_rollback")


def read_master(annotations: Element | None) -> MasterChoices:
    """Read the master's annotation among those of a description.

    Parameters
    ----------
    annotations : Element or None
        ``ssd:Annotations`` of the root element; annotations of others are passed over.

    Returns
    -------
    MasterChoices
        Empty where there is no such annotation.

    Raises
    ------
    SystemFileError
        For a setting that does not exist or is not of its type.
    """
    ours = [] if annotations is None else _ours(annotations)
    if not ours:
        return MasterChoices()
    if len(ours) > 1:
        raise ours[1].error(f"there are two annotations of the type {annotation_type}")
    ours[0].allow(attributes=["type"], children=["master:Master"])
    master = ours[0].child("master:Master")
    if master is None:
        raise ours[0].error("master:Master is missing")
    master.allow(attributes=setting_names, children=["master:Event", "master:Bond"])
    events = []
    for event in master.children("master:Event"):
        event.allow(attributes=["indicator"])
        events.append(event.need("indicator"))
    bonds = []
    for bond in master.children("master:Bond"):
        bond.allow(attributes=["force", "motion"])
        bonds.append((bond.need("force"), bond.need("motion")))
    settings = {
        name: _read_setting(master, name) for name in setting_names if master.text(name) is not None
    }
    return MasterChoices(settings=settings, events=tuple(events), bonds=tuple(bonds))


def refuse_master(annotations: Element | None) -> None:
    """Refuse the master's annotation where it has no effect."""
    for annotation in [] if annotations is None else _ours(annotations):
        raise annotation.error(
            f"an annotation of the type {annotation_type} belongs into ssd:Annotations of "
            "ssd:SystemStructureDescription"
        )


def _ours(annotations: Element) -> list[Element]:
    return [item for item in annotations.children("ssc:Annotation") if _is_ours(item)]


def _is_ours(annotation: Element) -> bool:
    kind = annotation.need("type")
    if kind == annotation_type:
        return True
    if kind.lower().startswith("org.railcosim"):
        raise annotation.error(
            f"the type {kind!r} is unknown; {close_matches(kind, [annotation_type])}"
        )
    return False


def _read_setting(master: Element, name: str) -> SettingValue:
    if name == "algorithm":
        return master.need(name)
    if name in _truths:
        return master.truth(name)
    return master.integer(name) if name in counts else master.number(name)
