"""Archives and documents made to do harm are refused before anything is unpacked or resolved."""

import stat
import zipfile

import pytest
import ssd_text as t

from orchestrator import FmuError, FmuParticipant, SystemFileError
from orchestrator.archives import ArchiveLimits, find_danger
from orchestrator.ssp import open_system


def archive(path, entries):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as target:
        for name, data in entries:
            target.writestr(name, data)
    return path


def link(name, mode=stat.S_IFLNK):
    info = zipfile.ZipInfo(name)
    info.external_attr = (mode | 0o777) << 16
    info.create_system = 3
    return info


def refused(path, **options):
    with pytest.raises(SystemFileError) as caught, open_system(path, **options):
        pass
    assert "\n" not in str(caught.value)
    assert str(caught.value).endswith(".")
    return str(caught.value)


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("../evil.txt", "leaves the folder"),
        ("resources/../../evil.txt", "leaves the folder"),
        ("/evil.txt", "leaves the folder"),
        ("C:/evil.txt", "leaves the folder"),
        ("C:evil.txt", "leaves the folder"),
        ("..\\evil.txt", "is no path with forward slashes"),
        (link("evil"), "is a link or another special file"),
        (link("evil", stat.S_IFIFO), "is a link or another special file"),
    ],
)
def test_entries_that_leave_the_folder_are_refused(tmp_path, name, why):
    entries = [("SystemStructure.ssd", t.ssd()), (name, "/etc/passwd")]
    path = archive(tmp_path / "evil.ssp", entries)
    before = sorted(tmp_path.parent.rglob("*"))
    assert f"{why}" in refused(path)
    assert sorted(tmp_path.parent.rglob("*")) == before


def test_an_archive_with_two_entries_of_one_name_is_refused(tmp_path):
    with pytest.warns(UserWarning, match="Duplicate name"):
        path = archive(tmp_path / "two.ssp", [("a", "1"), ("a", "2")])
    assert "2 entries of the name 'a'" in refused(path)


@pytest.mark.parametrize(
    ("limits", "why"),
    [
        ({"entries": 2}, "it has 3 entries, but at most 2 are unpacked"),
        ({"total_size": 1_000_000}, "it holds 2e+06 bytes, but at most 1e+06 are unpacked"),
        ({"free_size": 1000}, "to 1, but at most 100 to 1 is unpacked"),
    ],
)
def test_oversized_archives_are_refused(tmp_path, limits, why):
    entries = [("a", b"0" * 1_000_000), ("b", b"0" * 1_000_000), ("c", b"")]
    path = archive(tmp_path / "bomb.ssp", entries)
    assert why in refused(path, limits=ArchiveLimits(**limits))
    with zipfile.ZipFile(path) as opened:
        assert find_danger(opened) is None


def test_an_entry_never_unpacks_to_more_than_it_declares(tmp_path):
    """The header says 10 bytes of a file of a million: nothing beyond them is written."""
    path = archive(tmp_path / "liar.ssp", [("a", b"0" * 1_000_000)])
    true, false = (1_000_000).to_bytes(4, "little"), (10).to_bytes(4, "little")
    path.write_bytes(path.read_bytes().replace(true, false))
    assert "the archive cannot be unpacked: Bad CRC-32" in refused(path)


def test_a_damaged_archive_is_refused(tmp_path):
    path = archive(tmp_path / "cut.ssp", [("SystemStructure.ssd", t.ssd())])
    path.write_bytes(path.read_bytes()[:-40])
    assert "no intact zip archive" in refused(path)


def test_an_archive_without_a_description_is_refused(tmp_path):
    path = archive(tmp_path / "empty.ssp", [("a", "1")])
    assert "holds no SystemStructure.ssd" in refused(path)


@pytest.mark.parametrize("source", ["../relay.fmu", "a/../../relay.fmu", "%2e%2e/relay.fmu"])
def test_a_source_outside_the_archive_is_refused(tmp_path, source):
    text = t.ssd([t.component("a", source=source)])
    path = archive(tmp_path / "out.ssp", [("SystemStructure.ssd", text), ("a/b", "")])
    assert "must be a file in the archive" in refused(path)


laughs = '<!DOCTYPE x [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>'
stolen = '<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]>'
remote = '<!DOCTYPE x SYSTEM "http://example.com/x.dtd">'


@pytest.mark.parametrize("head", [laughs, stolen, remote])
def test_document_types_and_entities_are_refused(put, head):
    assert "document type with its entities is refused" in refused(put(t.ssd(head=head)))


@pytest.mark.parametrize("encoding", ["utf-16", "latin-1"])
def test_only_utf_8_is_read_so_that_nothing_hides(put, encoding):
    path = put("")
    path.write_bytes(t.ssd(head=laughs).replace("ha", "hä").encode(encoding))
    assert "not UTF-8" in refused(path)


def test_an_endless_document_is_refused(put, monkeypatch):
    monkeypatch.setattr("orchestrator.ssp.documents.largest_document", 100)
    assert "but at most 100 are read" in refused(put(t.ssd()))


def test_parameter_files_are_read_with_the_same_care(put):
    put(f"{laughs}<ssv:ParameterSet {t.spaces}/>", "values.ssv")
    text = t.bindings('<ssd:ParameterBinding source="values.ssv"/>')
    path = put(t.ssd([t.component("a", t.connectors() + text)]))
    assert refused(path).startswith("values.ssv: a document type")


def test_fmus_are_opened_with_the_same_care(relay, tmp_path):
    with zipfile.ZipFile(relay) as source:
        description = source.read("modelDescription.xml").decode()
    slipped = archive(
        tmp_path / "slip.fmu", [("modelDescription.xml", description), ("../evil", "")]
    )
    with pytest.raises(FmuError, match=r"^slip\.fmu: the archive is not unpacked: its entry"):
        FmuParticipant(slipped)
    head, _, rest = description.partition("?>")
    laughing = archive(
        tmp_path / "laugh.fmu", [("modelDescription.xml", f"{head}?>{laughs}{rest}")]
    )
    with pytest.raises(FmuError, match=r"^laugh\.fmu: a document type"):
        FmuParticipant(laughing)
