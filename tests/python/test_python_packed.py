# SPDX-License-Identifier: Apache-2.0
"""Packed streams in Python: some frames, all of them, and files that are not what they say."""
import json
import shutil
import struct
import sys

import numpy
import pytest
import xxhash

import throng_io
from throng_io.bakes import packed

LAYOUT = {"throng": 1, "simulation": {"duration": 10, "seed": 5},
          "roads": [{"id": "road", "centreline": [[0, 0], [12, 0]], "width": 6}],
          "flows": [{"id": "east", "from": "road:start", "to": "road:end", "count": 8, "end": 6}]}


@pytest.fixture(scope="module")
def bakes(throng, once):
    def make(folder):
        throng_io.bake(LAYOUT, folder / "exact", program=throng.binary)
        (folder / "layout.json").write_text(json.dumps(LAYOUT))
        throng("bake", folder / "layout.json", "-o", folder / "packed", "--streams", "packed", "-q")

    folder = once("python-packed", make)
    return throng_io.Bake(folder / "exact"), folder / "packed"


@pytest.fixture
def own(bakes, tmp_path):
    shutil.copytree(bakes[1], tmp_path / "bake")
    return tmp_path / "bake"


def test_some_frames_are_those_of_all_and_take_no_more_than_their_blocks(bakes, monkeypatch):
    exact, folder = bakes
    unpacked = []
    whole = packed.PackedStream._decompressed
    monkeypatch.setattr(packed.PackedStream, "_decompressed",
                        lambda self, index, most: unpacked.append(index) or whole(self, index, most))
    bake = throng_io.Bake(folder)
    some = bake.read("pos", 70, 130)
    assert unpacked == [1, 2] and some.shape == (60, 8, 3)
    assert numpy.abs(some - exact.pos[70:130]).max() <= bake.about["streams"]["pos"]["packed_error"][0]
    assert numpy.array_equal(bake.read("pos", 0, 240), bake.pos) and bake.read("pos", 9, 9).shape == (0, 8, 3)
    assert numpy.array_equal(exact.read("pos", 70, 130), exact.pos[70:130])


def test_what_is_large_is_unpacked_into_a_file(bakes, monkeypatch):
    before = throng_io.Bake(bakes[1]).dir
    monkeypatch.setattr(packed, "_IN_MEMORY", 1000)
    after = throng_io.Bake(bakes[1]).dir
    assert isinstance(after, numpy.memmap) and not after.flags.writeable and numpy.array_equal(before, after)


def test_all_else_of_the_package_takes_packed_bakes(bakes, tmp_path):
    exact, folder = bakes
    bake = throng_io.Bake(folder)
    assert numpy.array_equal(bake.there(), exact.there()) and numpy.array_equal(bake.activity(), exact.activity())
    bake.to_csv(tmp_path / "people.csv", every=12)
    exact.to_csv(tmp_path / "exact.csv", every=12)
    assert len((tmp_path / "people.csv").read_text().splitlines()) == \
        len((tmp_path / "exact.csv").read_text().splitlines())


@pytest.mark.parametrize("library", ["xxhash", "zstandard"])
def test_without_a_library_the_error_says_what_brings_it(bakes, monkeypatch, library):
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(throng_io.MissingExtra, match=r"throng-io\[packed\]"):
        throng_io.Bake(bakes[1]).pos  # noqa: B018
    assert throng_io.Bake(bakes[1]).people["radius"].min() > 0


def test_every_truncation_is_an_error_and_no_flip_changes_anything(own):
    path = own / "streams/pos.packed"
    content, expected = path.read_bytes(), throng_io.Bake(own).pos
    for length in range(0, len(content), 7):
        path.write_bytes(content[:length])
        with pytest.raises(throng_io.BakeError, match="throng verify"):
            throng_io.Bake(own).pos  # noqa: B018
    for at in range(0, len(content), 11):
        path.write_bytes(content[:at] + bytes([content[at] ^ 1 << at % 8]) + content[at + 1:])
        try:
            assert numpy.array_equal(throng_io.Bake(own).pos, expected)
        except throng_io.BakeError:
            pass


def directory_of(content):
    return struct.unpack_from("<Q", content, len(content) - 32)[0]


@pytest.mark.parametrize("offset, value", [(0, 2), (4, 0xffffffff), (4, 239), (8, 0xffffffff), (8, 7), (12, 0),
                                           (12, 0x10000), (16, 0xffffffff), (20, 4), (72, 0xffffffff), (84, 0)])
def test_directories_that_cannot_be_are_errors(throng, own, confined, offset, value):
    """Told by the package, and by the program, whose bounds are in memory and time, though the checksum is right."""
    path = own / "streams/pos.packed"
    content = bytearray(path.read_bytes())
    struct.pack_into("<I", content, directory_of(content) + offset, value)
    with pytest.raises(throng_io.BakeError, match="the checksum is another one"):
        path.write_bytes(content)
        throng_io.Bake(own).pos  # noqa: B018
    struct.pack_into("<Q", content, len(content) - 16, xxhash.xxh3_64_intdigest(content[directory_of(content):-32]))
    path.write_bytes(content)
    with pytest.raises(throng_io.BakeError) as told:
        throng_io.Bake(own).pos  # noqa: B018
    assert "checksum" not in str(told.value)
    assert "pos.packed" in confined("measure", own, expect=3, megabytes=500).stderr


def test_a_bake_of_more_people_than_its_streams_is_an_error(throng, own):
    manifest = json.loads((own / "bake.json").read_text())
    manifest["agents"] += 1
    del manifest["checksum"]
    (own / "bake.json").write_text(json.dumps(manifest))
    with pytest.raises(throng_io.BakeError, match="expected"):
        throng_io.Bake(own).pos  # noqa: B018
    assert "8 people" in throng("measure", own, expect=3).stderr
