"""A truncated or altered resource is refused in words, whatever is wrong with it."""

import struct
import zlib

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fmu_src.native.model_resources import vehicle_resource
from fmu_src.native.resource import ENTRY, HEAD, pack

from .library import NativeError, aligned, create

SECTIONS = 15  # of a track


def refuse(library, data, match):
    with pytest.raises(NativeError, match=match) as refusal:
        create(library, aligned(data), len(data))
    assert str(refusal.value).count(".") <= 2  # one sentence


def with_checksum(data):
    """The data with a head that fits them."""
    changed = bytearray(data)
    struct.pack_into("<Q", changed, 16, len(data))
    struct.pack_into("<I", changed, 24, zlib.crc32(bytes(changed[HEAD.size :])))
    return bytes(changed)


@settings(
    max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(place=st.floats(0.0, 1.0, exclude_max=True), flip=st.integers(1, 255))
def test_every_altered_byte_is_noticed(libraries, resources, place, flip):
    data = bytearray(resources["vehicle"])
    data[int(place * len(data))] ^= flip
    refuse(libraries["vehicle"], bytes(data), "resource")


def test_truncated(libraries, resources):
    for model, data in resources.items():
        for length in (0, 1, 31, 32, 79, len(data) // 2, len(data) - 1):
            refuse(libraries[model], data[:length], "resource")


def test_resource_of_the_other_model(libraries, resources):
    refuse(libraries["track"], resources["vehicle"], "not that of a Track")


@settings(
    max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    entry=st.integers(0, SECTIONS - 1),
    field=st.sampled_from([(24, "I"), (32, "Q"), (40, "Q")]),
    value=st.one_of(st.integers(0, 300), st.integers(0, 2**64 - 1)),
)
def test_table_of_contents_that_lies(libraries, resources, entry, field, value):
    """With a checksum that fits: a type, place or count that is impossible or not the model's."""
    data = bytearray(resources["track"])
    place, kind = field
    at = HEAD.size + entry * ENTRY.size + place
    value &= 2 ** (8 * struct.calcsize(kind)) - 1
    if struct.unpack_from(f"<{kind}", data, at)[0] == value:
        return
    struct.pack_into(f"<{kind}", data, at, value)
    altered = with_checksum(bytes(data))
    if place == 32 and value % 64 == 0 and value < len(data):
        return  # other numbers in the same place are no damage that can be seen
    refuse(libraries["track"], altered, "resource")


@pytest.mark.parametrize(
    "structure",
    [[0, 1], [-1, 1], [2, 1, 1], [2**62, 1], [], [2, 0], [3, 2], [2, 2**62]],
    ids=["none", "negative", "three", "huge", "empty", "no bogie", "odd", "huge bogies"],
)
def test_structure_that_makes_no_sense(libraries, structure):
    sections = {"model": b"Vehicle", "structure": np.array(structure, dtype=np.int64)}
    refuse(libraries["vehicle"], pack(sections), "how many wheels")


@pytest.mark.parametrize("value", [0.0, -0.65, np.nan, np.inf])
def test_track_that_cannot_be(libraries, value):
    structure = np.array([1, 0, 4, 2, 3, 8, 1, 0], dtype=np.int64)
    numbers = np.array([value, 46.0, 8e7, 1e4, 3e7, 3e4])
    sections = {"model": b"Track", "structure": structure, "numbers": numbers}
    refuse(libraries["track"], pack(sections), r"resource describes a track that cannot be")


@pytest.mark.parametrize(
    ("place", "value"), [(0, 0), (2, 1), (4, 0), (5, 7), (5, 0), (1, -1), (6, 0), (6, 1001), (7, 1)]
)
def test_size_that_cannot_be(libraries, place, value):
    structure = np.array([1, 0, 4, 2, 3, 8, 1, 0], dtype=np.int64)
    structure[place] = value
    sections = {"model": b"Track", "structure": structure}
    refuse(libraries["track"], pack(sections), "how large the track is")


def test_missing_start_values(libraries):
    sections = {"model": b"Vehicle", "structure": np.array([2, 1], dtype=np.int64)}
    refuse(libraries["vehicle"], pack(sections), "numbers named 'start'")
    numbers = {"start": np.zeros(34)}
    refuse(libraries["vehicle"], pack(sections | numbers), "no start value of speed_table")


def test_later_format(libraries, resources):
    data = bytearray(resources["vehicle"])
    struct.pack_into("<I", data, 8, 2)
    refuse(libraries["vehicle"], bytes(data), "format 2; this program reads 1")


def test_number_of_sections(resources):
    assert struct.unpack_from("<I", resources["track"], 12)[0] == SECTIONS


def test_resources_are_reproducible():
    assert vehicle_resource(wheels=3) == vehicle_resource(wheels=3)


def test_sections_that_cannot_be_written():
    with pytest.raises(ValueError, match="at most 23 fit"):
        pack({"x" * 24: b""})
    with pytest.raises(ValueError, match="use float64 or int64"):
        pack({"x": np.zeros(2, dtype=np.float32)})
