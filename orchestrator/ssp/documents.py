"""XML documents of a system description, read without trust and without overlooking anything."""

from collections.abc import Collection
from math import isfinite
from pathlib import Path
from typing import Any

from lxml import etree

from ..errors import SystemFileError, close_matches

namespaces = {
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
    "ssm": "http://ssp-standard.org/SSP1/SystemStructureParameterMapping",
    "master": "urn:railcosim:master",
}
"""Prefixes as messages and this package's code write them; SSP 2.0 kept those of 1.0."""

largest_document = 50 * 1024**2
"""Bytes of an XML file that are read at most."""

told_to_people = frozenset(
    {
        "id",
        "description",
        "author",
        "fileversion",
        "copyright",
        "license",
        "generationTool",
        "generationDateAndTime",
    }
)
"""Attributes without a meaning for a simulation, allowed everywhere."""

_prefixes = {uri: prefix for prefix, uri in namespaces.items()}


class Element:
    """An XML element that knows where it stands.

    Parameters
    ----------
    raw : lxml.etree element
        The element.
    file : str
        Name of its file, for messages.
    """

    def __init__(self, raw: Any, file: str) -> None:  # noqa: ANN401 - lxml carries no types
        self._raw = raw
        self.file = file

    @property
    def tag(self) -> str:
        """Name with its prefix, as in `namespaces`, whatever prefix the file uses."""
        name = etree.QName(self._raw)
        prefix = _prefixes.get(name.namespace, name.namespace)
        return f"{prefix}:{name.localname}" if prefix else str(name.localname)

    def allow(self, *, attributes: Collection[str] = (), children: Collection[str] = ()) -> None:
        """Refuse every other attribute and child element.

        Attributes in a namespace of their own, such as ``xsi:schemaLocation``, are not looked at.

        Raises
        ------
        SystemFileError
            For one that is not known here, since leaving it out might change the meaning.
        """
        for name in self._raw.attrib:
            if not name.startswith("{") and name not in attributes and name not in told_to_people:
                raise self.error(
                    f"the attribute {name!r} is not supported; {close_matches(name, attributes)}"
                )
        for child in self.children():
            if child.tag not in children:
                raise child.error("it is not supported here")

    def children(self, tag: str | None = None) -> list["Element"]:
        """Return the child elements, or those of one name."""
        found = [Element(raw, self.file) for raw in self._raw]
        return [child for child in found if tag is None or child.tag == tag]

    def child(self, tag: str) -> "Element | None":
        """Return the only child of a name, or None."""
        found = self.children(tag)
        if len(found) > 1:
            raise found[1].error("it may stand there only once")
        return found[0] if found else None

    def text(self, name: str) -> str | None:
        """Return an attribute as it is, or None where it is missing."""
        value: str | None = self._raw.get(name)
        return value

    def need(self, name: str) -> str:
        """Return an attribute that has to be there."""
        value = self.text(name)
        if value is None:
            raise self.error(f"the attribute {name!r} is missing")
        return value

    def number(self, name: str, default: float | None = None) -> float:
        """Return an attribute that is a finite number."""
        text = self.text(name)
        if text is None and default is not None:
            return default
        text = self.need(name)
        try:
            value = float(text)
        except ValueError:
            value = float("nan")
        if not isfinite(value):
            raise self.error(f"{name} is {text!r} but must be one finite number")
        return value

    def integer(self, name: str, default: int | None = None) -> int:
        """Return an attribute that is a whole number."""
        text = self.text(name)
        if text is None and default is not None:
            return default
        text = self.need(name)
        try:
            return int(text)
        except ValueError:
            raise self.error(f"{name} is {text!r} but must be one whole number") from None

    def truth(self, name: str, default: bool | None = None) -> bool:
        """Return an attribute that is true or false."""
        text = self.text(name)
        if text is None and default is not None:
            return default
        text = self.need(name)
        values = {"true": True, "1": True, "false": False, "0": False}
        if text.strip() not in values:
            raise self.error(f"{name} is {text!r} but must be true or false")
        return values[text.strip()]

    def error(self, problem: str) -> SystemFileError:
        """Return an error that says where it is and what is wrong."""
        return SystemFileError(f"{self.file}, line {self._raw.sourceline}: {self.tag}: {problem}.")


def read_document(path: Path, root: str) -> Element:
    """Read an XML file; entities, document types and the network are out of reach.

    Parameters
    ----------
    path : pathlib.Path
        The file.
    root : str
        Name that the root element must have, as in ``ssd:SystemStructureDescription``.

    Raises
    ------
    SystemFileError
        When it is missing, too large, no UTF-8, not well-formed, has a document type or is
        something else.
    """
    text = _read_text(path)
    parser = etree.XMLParser(
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        huge_tree=False,
        remove_comments=True,
        remove_pis=True,
    )
    try:
        raw = etree.fromstring(text.encode(), parser)
    except etree.XMLSyntaxError as error:
        problem = " ".join(str(error.msg).split()).rstrip(".")
        raise SystemFileError(f"{path.name}: the XML is not well-formed: {problem}.") from error
    element = Element(raw, path.name)
    if element.tag != root:
        raise element.error(f"the root element must be {root}")
    version = element.need("version")
    if version.partition(".")[0] not in {"1", "2"}:
        raise element.error(f"version {version!r} is not supported, only 1.0 and 2.0 are")
    return element


def _read_text(path: Path) -> str:
    try:
        size = path.stat().st_size
        if size > largest_document:
            raise SystemFileError(
                f"{path.name}: the file has {size} bytes, but at most {largest_document} are read."
            )
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise SystemFileError(f"{path}: the file cannot be read ({error.strerror}).") from error
    except UnicodeDecodeError as error:
        raise SystemFileError(f"{path.name}: the file is not UTF-8, as SSP has it.") from error
    # Before the parser sees it: even a parser that resolves nothing has to read the declarations.
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise SystemFileError(
            f"{path.name}: a document type with its entities is refused; remove the DOCTYPE."
        )
    return text
