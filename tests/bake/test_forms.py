# SPDX-License-Identifier: Apache-2.0
"""The forms in which streams lie on the disk: whichever a bake has, everything reads it the same."""
import itertools
import json
import os
import shutil
import signal
import subprocess
import sys
import time

import numpy
import pytest

import throng_io
from conftest import ROOT
from test_bakes import SMALL, write

sys.path.insert(0, str(ROOT / "blender_addon"))
from throng import formats as addon  # noqa: E402

EXACT = ("npy", "pc2")
FORMS = (*EXACT, "packed")
STREAMS = ("pos", "dir", "state", "chest")
ALL = (*STREAMS, "density", "wish", "left_foot", "right_foot", "carriage", "gaze", "attention")
SUBSETS = [",".join(some) for count in (1, 2, 3) for some in itertools.combinations(FORMS, count)]


@pytest.fixture(scope="module")
def crowds(throng, once):
    """crowds("npy") is the same crowd in that form, or in several."""

    def bake(forms):
        def make(folder):
            throng("bake", write(folder / "layout.json", SMALL), "-o", folder / "bake", "-q", "--density", "--wish",
                   "--feet", "--gaze", "--attention", *(["--streams", forms] if forms else []))

        return once(f"forms-{forms}", make) / "bake"

    return bake


def names(bake):
    return {path.name for path in (bake / "streams").iterdir()}


@pytest.mark.quick
def test_both_are_written_unless_told(crowds, manifest_of):
    assert names(crowds("")) == {f"{stream}.{form}" for stream in ALL for form in EXACT}
    plain, told = manifest_of(crowds("")), manifest_of(crowds("npy,pc2"))
    assert plain["files"] == told["files"] and plain["inputs"] == told["inputs"]
    assert list(plain["streams"]["pos"]) == ["npy", "pc2", "components", "units", "interpolation"]


@pytest.mark.parametrize("forms", SUBSETS)
def test_what_is_asked_for_is_there_and_everything_reads_it(throng, crowds, manifest_of, tmp_path, forms):
    bake, plain = crowds(forms), crowds("")
    listed = {entry["path"]: entry["xxh3"] for entry in manifest_of(plain)["files"]}
    for stream, told in manifest_of(bake)["streams"].items():
        assert [form for form in told if form in FORMS] == forms.split(",")
    assert names(bake) == {f"{stream}.{form}" for stream in ALL for form in forms.split(",")}
    is_exact = forms != "packed"
    for entry in manifest_of(bake)["files"]:
        if entry["path"] in listed and entry["path"] != "layout.json" and (is_exact or entry["path"] != "crowd.glb"):
            assert listed[entry["path"]] == entry["xxh3"], entry["path"]
    throng("verify", bake, "-q")
    assert f"as {forms}\n" in throng("info", bake).stdout
    measured, same = (json.loads(throng("measure", each, "--json").stdout) for each in (bake, plain))
    assert measured == same if is_exact else is_close(measured, same)
    for each in (bake, plain):
        throng("preview", each, "-o", tmp_path / f"{each == bake}.png")
    assert not is_exact or (tmp_path / "True.png").read_bytes() == (tmp_path / "False.png").read_bytes()
    throng("report", bake, "-o", tmp_path / "page.html")
    throng("compare", bake, plain)


def is_close(measured, same):
    """Of what does not tell how people shake."""
    keys = ("agents", "arrived", "walking", "refused", "stuck", "mean_speed", "mean_density", "wall_crossings")
    return all(measured[key] == pytest.approx(same[key], rel=1e-3) for key in keys)


@pytest.mark.parametrize("forms", SUBSETS)
def test_the_package_reads_it_to_within_what_is_told(crowds, forms):
    opened, plain = throng_io.Bake(crowds(forms)), throng_io.Bake(crowds(""))
    for stream in ALL:
        off = numpy.abs(opened.stream(stream).astype(float) - plain.stream(stream)).max(axis=(0, 1))
        told = opened.about["streams"][stream].get("packed_error", [0, 0, 0])
        assert (off <= (told if forms == "packed" else 0)).all(), (stream, off)
        assert numpy.array_equal(opened.read(stream, 3, 70), opened.stream(stream)[3:70])
        assert not opened.stream(stream).flags.writeable


@pytest.mark.parametrize("forms", SUBSETS)
def test_a_file_that_is_missing_is_told_and_only_that(throng, crowds, tmp_path, forms):
    shutil.copytree(crowds(forms), tmp_path / "bake")
    gone = f"streams/dir.{forms.split(',')[0]}"
    (tmp_path / "bake" / gone).unlink()
    told = json.loads(throng("verify", tmp_path / "bake", "--json", "-q", expect=3).stdout)["problems"]
    assert [(problem["path"], problem["kind"]) for problem in told] == [(gone, "missing")]
    assert gone.split("/")[1] in throng("measure", tmp_path / "bake", expect=3).stderr


@pytest.mark.parametrize("words, wrong", [("pc3", "`pc3`"), ("", "missing"), ("npy,", "``"), ("npy;pc2", "`npy;pc2`")])
def test_a_form_that_is_none_is_an_error_before_any_work(throng, tmp_path, words, wrong):
    layout = write(tmp_path / "layout.json", SMALL)
    told = throng("bake", layout, "-o", tmp_path / "bake", f"--streams={words}", expect=2).stderr
    assert wrong in told and ("npy (NumPy arrays)" in told or not words) and not (tmp_path / "bake").exists()


@pytest.mark.parametrize("forms", SUBSETS)
def test_a_bake_that_was_stopped_goes_on_in_its_form_to_the_same_bytes(throng, tmp_path, manifest_of, forms):
    layout = write(tmp_path / "layout.json", {**SMALL, "simulation": {"duration": 40}})
    arguments = ["bake", str(layout), "-q", "--no-gltf", "--streams", forms]
    throng(*arguments, "-o", tmp_path / "whole")
    stopped = subprocess.Popen([throng.binary, *arguments, "-o", str(tmp_path / "bake"), "--checkpoint", "0.0001"],
                               stderr=subprocess.PIPE)
    unfinished = tmp_path / "bake.unfinished"
    while stopped.poll() is None and not list(unfinished.glob("checkpoint.[ab]")):
        time.sleep(0.005)
    stopped.send_signal(signal.SIGTERM)
    stopped.communicate()
    if not (tmp_path / "bake").exists():
        other = "pc2" if forms == "npy" else "npy"  # than the one that it was begun with
        told = throng(*arguments[:-1], other, "-o", tmp_path / "bake", "--resume", expect=5).stderr
        assert "other options" in told
    throng(*arguments, "-o", tmp_path / "bake", "--resume")
    assert manifest_of(tmp_path / "bake")["files"] == manifest_of(tmp_path / "whole")["files"]
    throng("verify", tmp_path / "bake", "-q")


@pytest.mark.parametrize("forms", SUBSETS)
def test_changes_are_written_in_the_forms_of_the_bake(throng, crowds, tmp_path, forms):
    changes = {"throng_overrides": 1, "overrides": []}
    write(tmp_path / "changes.json", changes)
    throng("apply", crowds(forms), "--overrides", tmp_path / "changes.json", "-o", tmp_path / "applied", "-q")
    assert names(tmp_path / "applied") == names(crowds(forms))
    for name in names(crowds(forms)):
        if not name.endswith(".packed"):  # who enters late is told of in another way there
            assert (tmp_path / "applied/streams" / name).read_bytes() == \
                (crowds(forms) / "streams" / name).read_bytes()
    for stream in STREAMS:
        assert numpy.array_equal(throng_io.Bake(tmp_path / "applied").stream(stream),
                                 throng_io.Bake(crowds(forms)).stream(stream))
    throng("verify", tmp_path / "applied", "-q")


def test_forms_are_converted_into_each_other(throng, crowds, manifest_of, tmp_path):
    shutil.copytree(crowds("npy"), tmp_path / "bake")
    throng("convert", tmp_path / "bake", "-o", tmp_path / "made", "--streams", "pc2", "-q")
    throng("convert", tmp_path / "made", "-o", tmp_path / "again", "--streams", "npy,pc2", "-q")
    throng("verify", tmp_path / "again", "-q")
    assert manifest_of(tmp_path / "again")["files"] == manifest_of(crowds(""))["files"]
    assert "exists" in throng("convert", tmp_path / "bake", "-o", tmp_path / "again", "-q", expect=5).stderr
    throng("convert", tmp_path / "bake", "-o", tmp_path / "bake", "--streams", "pc2", "-q", "--force")
    assert {os.path.splitext(name)[1] for name in names(tmp_path / "bake")} == {".pc2"}
    throng("verify", tmp_path / "bake", "-q")
    path = tmp_path / "bake/streams/pos.pc2"
    content = path.read_bytes()
    path.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
    assert "changed" in throng("convert", tmp_path / "bake", "-o", tmp_path / "bad", expect=3).stderr
    assert not list(tmp_path.glob("bad*"))


def test_packing_again_changes_nothing(throng, crowds, tmp_path):
    throng("convert", crowds("packed"), "-o", tmp_path / "plain", "--streams", "npy", "-q")
    throng("convert", tmp_path / "plain", "-o", tmp_path / "packed", "--streams", "packed", "-q")
    for stream in ALL:
        made = [throng_io.Bake(bake).stream(stream) for bake in (crowds("packed"), tmp_path / "plain",
                                                                 tmp_path / "packed")]
        assert numpy.array_equal(made[0], made[1]) and numpy.array_equal(made[0], made[2])


def test_batches_have_their_bakes_in_the_forms_that_they_ask_for(throng, tmp_path):
    layout = {**SMALL, "simulation": {"duration": 2}}
    family = {"throng_family": 1, "name": "small", "base": layout, "bake": {"streams": "pc2"},
              "axes": [{"set": "/simulation/seed", "values": [1, 2]}]}
    plan = write(tmp_path / "family.json", family)
    throng("batch", plan, "-o", tmp_path / "batch", "-q")
    bakes = sorted((tmp_path / "batch/bakes").iterdir())
    assert len(bakes) == 2 and all(names(bake) == {f"{stream}.pc2" for stream in STREAMS} for bake in bakes)
    family["bake"]["streams"] = "pc4"
    told = throng("batch", write(tmp_path / "wrong.json", family), "-o", tmp_path / "wrong", "-q", expect=3).stderr
    assert "/bake/streams" in told and "`pc4`" in told and "hint" in told


def test_the_add_on_says_what_makes_a_bake_that_it_can_play(crowds):
    for forms in ("npy", "packed", "npy,packed"):
        with pytest.raises(addon.NoPointCaches, match=r"throng convert .* --streams pc2"):
            addon.load_bake(str(crowds(forms)))
    assert addon.load_bake(str(crowds("pc2"))).agents > 0


def test_streams_that_have_no_form_in_common_are_an_error(throng, crowds, tmp_path):
    shutil.copytree(crowds("npy"), tmp_path / "bake")
    manifest = json.loads((tmp_path / "bake/bake.json").read_text())
    manifest["streams"]["dir"]["pc2"] = manifest["streams"]["dir"].pop("npy")
    del manifest["checksum"]
    write(tmp_path / "bake/bake.json", manifest)
    assert "/streams" in throng("info", tmp_path / "bake", expect=3).stderr
