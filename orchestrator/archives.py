"""What makes a zip archive of a stranger dangerous to unpack."""

import stat
from collections import Counter
from dataclasses import dataclass
from pathlib import PurePosixPath
from zipfile import ZipFile, ZipInfo


@dataclass(frozen=True, slots=True, kw_only=True)
class ArchiveLimits:
    """What an archive may amount to.

    Attributes
    ----------
    entries : int
        Files and folders in it.
    total_size : int
        Bytes of all files once unpacked.
    ratio : float
        Unpacked over packed bytes, where `free_size` is exceeded.
    free_size : int
        Unpacked bytes up to which the ratio does not matter.
    """

    entries: int = 10_000
    total_size: int = 2 * 1024**3
    ratio: float = 100.0
    free_size: int = 64 * 1024**2


default_limits = ArchiveLimits()


def find_danger(archive: ZipFile, limits: ArchiveLimits = default_limits) -> str | None:
    """Say why an archive must not be unpacked.

    Sizes are those that the archive declares; zipfile never unpacks more of an entry than that.

    Parameters
    ----------
    archive : zipfile.ZipFile
        Opened for reading.
    limits : ArchiveLimits
        What it may amount to.

    Returns
    -------
    str or None
        A clause, or None where nothing is wrong.
    """
    entries = archive.infolist()
    if len(entries) > limits.entries:
        return f"it has {len(entries)} entries, but at most {limits.entries} are unpacked"
    for entry in entries:
        clause = _find_danger_of_entry(entry)
        if clause is not None:
            return f"its entry {entry.orig_filename!r} {clause}"
    for name, count in Counter(entry.filename for entry in entries).items():
        if count > 1:
            return f"it has {count} entries of the name {name!r}"
    unpacked = sum(entry.file_size for entry in entries)
    packed = sum(entry.compress_size for entry in entries)
    if unpacked > limits.total_size:
        return f"it holds {unpacked:.3g} bytes, but at most {limits.total_size:.3g} are unpacked"
    if unpacked > limits.free_size and unpacked > limits.ratio * packed:
        return (
            f"it is packed {unpacked / max(packed, 1):.0f} to 1, but at most {limits.ratio:g} to 1 "
            "is unpacked"
        )
    return None


def _find_danger_of_entry(entry: ZipInfo) -> str | None:
    # The name as it stands in the archive: zipfile cuts it at a zero byte and changes separators.
    name = entry.orig_filename
    path = PurePosixPath(name)
    if "\\" in name or "\0" in name or not path.parts:
        return "is no path with forward slashes"
    if path.is_absolute() or ":" in path.parts[0] or ".." in path.parts:
        return "leaves the folder it is unpacked to"
    kind = stat.S_IFMT(entry.external_attr >> 16)
    if kind not in {0, stat.S_IFREG, stat.S_IFDIR}:
        return "is a link or another special file"
    if entry.flag_bits & 1:
        return "is encrypted"
    return None
