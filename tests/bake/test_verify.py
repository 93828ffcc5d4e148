# SPDX-License-Identifier: Apache-2.0
"""`throng verify`: every file of a bake against the list in its bake.json; by the add-on, too, which has to find the
same."""
import ctypes
import ctypes.util
import json
import os
import random
import shutil
import sqlite3
import sys

import pytest

from conftest import ROOT
from test_bakes import SMALL, write

sys.path.insert(0, str(ROOT / "blender_addon"))
from throng.formats import Bake, read_manifest  # noqa: E402
from throng.formats.listed_files import file_problems  # noqa: E402
from throng.formats.xxh3 import hash_of  # noqa: E402


@pytest.fixture(scope="module")
def baked(throng, once):
    def make(folder):
        layout = write(folder / "layout.json", SMALL)
        throng("bake", layout, "-o", folder / "bake", "-q", "--density", "--diagrams", "24")

    return once("verified-bake", make) / "bake"


@pytest.fixture
def own(baked, tmp_path):
    shutil.copytree(baked, tmp_path / "bake")
    return tmp_path / "bake"


def flip(path, at, bit=0):
    content = bytearray(path.read_bytes())
    content[at] ^= 1 << bit
    path.write_bytes(content)


def verified(throng, bake, expect):
    """{path: kind} of the problems; the text and the add-on name the same paths."""
    document = json.loads(throng("verify", bake, "--json", "-q", expect=expect).stdout)
    found = {problem["path"]: problem["kind"] for problem in document["problems"]}
    assert document["outcome"] == {0: "whole", 1: "no checksums", 3: "damaged"}[expect]
    lines = throng("verify", bake, "-q", expect=expect).stderr.splitlines()
    if expect == 3:
        assert len(lines) == len(found) and all(any(line.startswith(f"{bake}/{path}: ") for line in lines)
                                                for path in found), "a line each"
    return found


def by_add_on(bake):
    return {path for path, _ in file_problems(Bake(read_manifest(str(bake)), str(bake)))}


@pytest.mark.quick
def test_a_whole_bake_is_whole_and_lists_every_file(throng, baked, manifest_of):
    assert "all 15 files" in throng("verify", baked).stdout and verified(throng, baked / "bake.json", 0) == {}
    listed = {entry["path"] for entry in manifest_of(baked)["files"]}
    assert listed == {path.relative_to(baked).as_posix() for path in baked.rglob("*.*")} - {"bake.json"}
    assert by_add_on(baked) == set()


@pytest.mark.parametrize("name", ["layout.json", "agents.csv", "crowd.glb", "streams/pos.npy", "streams/density.pc2",
                                  "diagrams/diagram.0001.exr"])
def test_damage_of_any_file_is_told(throng, own, name):
    path = own / name
    whole = path.read_bytes()
    for at in (0, len(whole) // 2, len(whole) - 1):
        flip(path, at)
        assert verified(throng, own, 3) == {name: "changed"} and by_add_on(own) == {name}
        path.write_bytes(whole)
    for content, kind in ((whole[:-1], "truncated"), (b"", "truncated"), (whole + b"\0", "too long")):
        path.write_bytes(content)
        assert verified(throng, own, 3) == {name: kind} and by_add_on(own) == {name}
    path.unlink()
    assert verified(throng, own, 3) == {name: "missing"} and by_add_on(own) == {name}
    path.mkdir()
    assert verified(throng, own, 3) == {name: "unreadable"} and by_add_on(own) == {name}
    path.rmdir()
    os.mkfifo(path)
    assert verified(throng, own, 3) == {name: "unreadable"} and by_add_on(own) == {name}


def test_strangers_and_renamed_files_are_told(throng, own):
    (own / "streams" / "notes.txt").write_text("mine")
    (own / "more" / "inner").mkdir(parents=True)
    (own / "more" / "inner" / "x").write_text("")
    (own / "agents.csv").rename(own / "people.csv")
    expected = {"streams/notes.txt": "stranger", "more/inner/x": "stranger", "people.csv": "stranger",
                "agents.csv": "missing"}
    assert verified(throng, own, 3) == expected and by_add_on(own) == set(expected)


def test_what_lies_beside_a_bake_is_none_of_it(throng, own):
    write(own.with_name("bake.overrides.json"), {"throng_overrides": 1, "overrides": []})
    own.with_name("bake.overrides").mkdir()
    (own / "checkpoint.a").write_text("of a process that was killed as it ended")
    assert verified(throng, own, 0) == {} and by_add_on(own) == set()


def test_links_lead_nowhere_outside(throng, own, tmp_path):
    shutil.move(own / "layout.json", tmp_path / "layout.json")
    os.symlink(tmp_path / "layout.json", own / "layout.json")
    assert verified(throng, own, 3) == {"layout.json": "unreadable"}
    assert "leads out of the folder" in throng("verify", own, expect=3).stderr
    os.remove(own / "layout.json")
    shutil.move(tmp_path / "layout.json", own / "layout.json")
    os.symlink("/", own / "root")
    assert verified(throng, own, 3) == {"root": "stranger"} and by_add_on(own) == {"root"}


def test_no_flipped_bit_of_the_manifest_goes_unseen(throng, own):
    path = own / "bake.json"
    whole = path.read_bytes()
    chance = random.Random(3)
    tail = len(whole) - 60  # where its own checksum is
    for at in [*chance.sample(range(tail), 30), *range(tail, len(whole), 3)]:
        flip(path, at, chance.randrange(7))
        assert "bake.json" in verified_manifest(throng, own), at
        path.write_bytes(whole)
    path.write_bytes(whole[:-20])
    assert "bake.json" in verified_manifest(throng, own)
    path.unlink()
    assert verified(throng, own, 3) == {"bake.json": "missing"}


def verified_manifest(throng, bake):
    document = json.loads(throng("verify", bake, "--json", "-q", expect=3).stdout)
    return {problem["path"] for problem in document["problems"]}


def test_bakes_without_checksums_are_an_outcome_of_their_own(throng, own):
    manifest = json.loads((own / "bake.json").read_text())
    del manifest["checksum"], manifest["files"]
    (own / "bake.json").write_text(json.dumps(manifest))
    assert verified(throng, own, 1) == {}
    assert "lists no checksums" in throng("verify", own, expect=1).stderr
    assert "lists no checksums" in next(file_problems(Bake(manifest, str(own))))[1]


def test_a_manifest_without_its_own_checksum_still_lists_files(throng, own):
    manifest = json.loads((own / "bake.json").read_text())
    del manifest["checksum"]
    (own / "bake.json").write_text(json.dumps(manifest, indent=1))
    assert verified(throng, own, 0) == {}
    flip(own / "agents.csv", 5)
    assert verified(throng, own, 3) == {"agents.csv": "changed"}


def test_what_is_no_bake_is_told(throng, tmp_path):
    assert "no bake's folder" in throng("verify", tmp_path / "absent", expect=3).stderr
    (tmp_path / "empty").mkdir()
    assert "bake.json: missing" in throng("verify", tmp_path / "empty", expect=3).stderr


def test_apply_takes_no_damage_over_and_lists_anew(throng, own, tmp_path):
    overrides = write(tmp_path / "o.json", {"throng_overrides": 1, "overrides": []})
    apply = lambda expect: throng("apply", own, "--overrides", overrides, "-o", tmp_path / "new", "-q", expect=expect)
    apply(0)
    assert verified(throng, tmp_path / "new", 0) == {}
    shutil.rmtree(tmp_path / "new")
    for name in ("streams/dir.npy", "layout.json"):
        whole = (own / name).read_bytes()
        flip(own / name, len(whole) - 2)
        said = apply(3).stderr
        assert name in said and "checksum" in said and not (tmp_path / "new").exists()
        (own / name).write_bytes(whole)
    apply(0)


def test_resume_leaves_a_whole_bake_and_refuses_a_damaged_one(throng, tmp_path):
    layout = write(tmp_path / "layout.json", SMALL)
    bake = lambda *words, expect=0: throng("bake", layout, "-o", tmp_path / "bake", "--no-gltf", "-q", *words,
                                           expect=expect)
    bake()
    stream = tmp_path / "bake" / "streams" / "pos.npy"
    whole = stream.read_bytes()
    assert "complete already" in throng("bake", layout, "-o", tmp_path / "bake", "--no-gltf", "--resume").stdout
    flip(stream, 1000)
    said = bake("--resume", expect=3).stderr
    assert "streams/pos.npy" in said and "--force" in said
    bake("--resume", "--force")
    assert stream.read_bytes() == whole


def test_a_batch_is_verified_whole_and_bakes_what_is_damaged_anew(throng, tmp_path):
    family = write(tmp_path / "family.json", {"throng_family": 1, "name": "three", "base": {
        **SMALL, "simulation": {"duration": 0.5}}, "bake": {"gltf": False},
        "axes": [{"name": "seed", "set": "/simulation/seed", "range": [1, 3]}]})
    batch = tmp_path / "out"
    throng("batch", family, "-o", batch, "-q")
    assert "3 of 3 bakes are whole" in throng("verify", batch, "-q").stdout
    first, second, third = sorted((batch / "bakes").iterdir())
    flip(first / "agents.csv", 40)
    shutil.rmtree(second)
    document = json.loads(throng("verify", batch, "--json", "-q", expect=3).stdout)
    assert [document[key] for key in ("outcome", "whole", "damaged", "missing", "not_baked")] == \
        ["damaged", 1, 1, 1, 0]
    told = throng("verify", batch, "-q", expect=3)
    assert f"{first}/agents.csv: changed" in told.stderr and f"{second}: missing" in told.stderr
    assert "1 of 3 bakes are whole" in told.stdout and "1 damaged" in told.stdout and "1 missing" in told.stdout
    before = third.stat().st_mtime_ns
    assert "1 bake is damaged and baked again" in throng("batch", family, "-o", batch).stdout
    assert "3 of 3 bakes are whole" in throng("verify", batch, "-q").stdout
    assert third.stat().st_mtime_ns == before, "what is whole is left as it is"
    with sqlite3.connect(batch / "results.sqlite") as database:
        database.execute("UPDATE scenarios SET bake = NULL, status = 'failed' WHERE number = 1")
    assert "scenarios without a bake: 1" in throng("verify", batch, "-q").stdout


def test_the_add_on_hashes_as_the_library_does(tmp_path):
    name = ctypes.util.find_library("xxhash")
    if not name:
        pytest.skip("libxxhash is not installed")
    library = ctypes.CDLL(name).XXH3_64bits
    library.restype, library.argtypes = ctypes.c_uint64, (ctypes.c_char_p, ctypes.c_size_t)
    chance = random.Random(1)
    for size in [*range(258), 511, 512, 513, 1023, 1024, 1025, 1087, 1088, 1089, 2048, 2049, (1 << 20) - 1, 1 << 20,
                 (1 << 20) + 1, (1 << 20) + 1025, 2_500_003]:
        content = chance.randbytes(size)
        (tmp_path / "file").write_bytes(content)
        assert hash_of(tmp_path / "file") == f"{library(content, size):016x}", size
