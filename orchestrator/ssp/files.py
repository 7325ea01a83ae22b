"""The files that a system description names."""

from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote, urlsplit

from .documents import Element


@dataclass(frozen=True, slots=True, kw_only=True)
class Folder:
    """The folder of a system description.

    Attributes
    ----------
    path : pathlib.Path
        The folder.
    is_closed : bool
        Whether files outside are out of reach, as they are for an archive.
    """

    path: Path
    is_closed: bool

    def find(self, element: Element) -> Path:
        """Return the file that the attribute ``source`` of an element names.

        Raises
        ------
        SystemFileError
            For a source that is missing, absolute, outside or not there.
        """
        source = element.need("source")
        path = self.resolve(source)
        if path is None:
            remedy = "in the archive" if self.is_closed else "relative to the description"
            raise element.error(f"the source {source!r} must be a file {remedy}")
        if not path.is_file():
            raise element.error(f"the source {source!r} does not exist")
        return path

    def resolve(self, source: str) -> Path | None:
        """Return the path of a relative URI, or None for one that may not be followed."""
        address = urlsplit(source)
        name = unquote(address.path)
        if address.scheme or address.netloc or not name or "\\" in name or "\0" in name:
            return None
        path = (self.path / name).resolve()
        within = path.is_relative_to(self.path.resolve())
        if Path(name).is_absolute() or (self.is_closed and not within):
            return None
        return path
