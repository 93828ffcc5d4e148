# SPDX-License-Identifier: Apache-2.0
"""The film look in a real Blender: its settings, and the layers of the files that it renders."""
import json
import math
import subprocess
import sys

import numpy
import OpenEXR
import pytest

from conftest import ROOT
from results import ADDON, HERE, result_of
from sample_bake import SMALL_CAST, write_bake
from throng import cast


CAST_MATERIALS = {f"throng {name}" for name in cast.people.MATERIALS}


WANTED = {"CryptoObject": ["Throng sample crowd", "Throng wall house"], "CryptoAsset": ["Throng sample crowd"],
          "CryptoMaterial": ["throng top", "throng skin"]}


def coverage(channels, layer, number):
    """How much of each pixel a Cryptomatte name covers. Pairs of a name's number and its share go through red,
    green, and blue, alpha."""
    wanted, total = numpy.uint32(int(number, 16)), 0.0
    for rank in range(3):
        planes = [next(c.pixels for name, c in channels.items()
                       if name.lower().endswith(f"{layer}0{rank}.{plane}".lower())) for plane in "RGBA"]
        for numbers, shares in (planes[:2], planes[2:]):
            known = numpy.ascontiguousarray(numbers, numpy.float32).view(numpy.uint32)
            total = total + numpy.where(known == wanted, shares, 0.0)
    return total


@pytest.fixture(scope="module")
def rendered(blender, tmp_path_factory):
    """(what check_film_look.py has seen, the folder with its pictures)."""
    folder = tmp_path_factory.mktemp("film_look")
    write_bake(folder / "bake", **SMALL_CAST)
    return result_of(blender(HERE / "check_film_look.py", ADDON, folder / "bake", folder)), folder


@pytest.mark.parametrize("preset, size", [("preview", [960, 540]), ("plate", [1920, 1080]), ("final", [1920, 1080])])
def test_a_look_sets_up_the_whole_scene(rendered, preset, size):
    found = rendered[0]
    look = found[preset]
    assert look["engine"] == "CYCLES" and look["size"] == size and look["blur"] == [True, 0.5]
    assert look["transform"] == ("AgX" if found["version"] >= [4, 0, 0] else "Filmic")
    assert look["format"] == ("PNG" if preset == "preview" else "OPEN_EXR_MULTILAYER")
    assert look["focus"] == (preset != "preview")
    assert math.dist(look["start"], look["end"]) > 0.5 and look["end"][2] > look["start"][2], "the crane rises"
    assert look["start"] == pytest.approx(found["preview"]["start"], abs=1e-4), "applied again, it is where it was"


def test_better_looks_take_more_samples(rendered):
    samples = [rendered[0][preset]["samples"] for preset in ("preview", "plate", "final")]
    assert samples == sorted(set(samples))


def layers_of(path):
    """(channels by name, {Cryptomatte layer: its manifest}) of a picture."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = {name: channel for part in file.parts for name, channel in part.channels.items()}
        header = {key: value for part in file.parts for key, value in part.header.items()}
    return channels, {header[key.replace("/manifest", "/name")].split(".")[-1]: json.loads(value)
                      for key, value in header.items() if key.startswith("cryptomatte/") and key.endswith("/manifest")}


@pytest.mark.parametrize("frame", [20, 21])
def test_a_plate_has_depth_mist_and_mattes(rendered, frame):
    channels, manifests = layers_of(rendered[1] / f"plate.{frame:04d}.exr")
    names = " ".join(channels)
    assert "CryptoAsset00" in names and "Mist" in names and ("Depth" in names or ".Z" in names)
    for kind, wanted in WANTED.items():
        assert set(wanted) <= set(manifests[kind])
        assert not any("person" in name or "pose" in name for name in manifests[kind])
    combined = next(channel for name, channel in channels.items() if name.endswith("Combined.R"))
    assert numpy.isfinite(combined.pixels).all() and combined.pixels.std() > 0.01


def test_the_crowds_matte_is_that_of_all_that_people_are_made_of(rendered):
    mattes = []
    for frame in (20, 21):
        channels, manifests = layers_of(rendered[1] / f"plate.{frame:04d}.exr")
        crowd = coverage(channels, "CryptoObject", manifests["CryptoObject"]["Throng sample crowd"])
        clothes = sum(coverage(channels, "CryptoMaterial", number)
                      for name, number in manifests["CryptoMaterial"].items() if name in CAST_MATERIALS)
        assert 0.005 < crowd.mean() < 0.9 and abs(crowd - clothes).max() < 1e-3
        mattes.append(crowd.mean())
    assert mattes[0] == pytest.approx(mattes[1], rel=0.2), "it goes on in the next frame, whatever poses people take"


def person_matte(folder, frame):
    """({name: its share of every pixel}, channels) of what scripts/person_mattes.py makes of a plate."""
    out = folder / f"people.{frame:04d}.exr"
    process = subprocess.run([sys.executable, ROOT / "scripts" / "person_mattes.py", folder / f"plate.{frame:04d}.exr",
                              out, folder / "bake"], capture_output=True, text=True)
    assert process.returncode == 0, process.stderr
    channels, manifests = layers_of(out)
    return {name: coverage(channels, "CryptoPerson", number)
            for name, number in manifests["CryptoPerson"].items()}, channels, manifests


@pytest.fixture(scope="module")
def persons(rendered):
    return {frame: person_matte(rendered[1], frame) for frame in (20, 21)}


@pytest.mark.parametrize("frame", [20, 21])
def test_everybody_has_a_matte_where_the_bake_says_they_are(rendered, persons, frame):
    mattes, _, _ = persons[frame]
    places, near = rendered[0]["seen"][str(frame)], 0
    rows, columns = numpy.mgrid[0:135, 0:240] + 0.5
    for name, share in mattes.items():
        if share.sum() < 25.0:  # less of somebody may be a hand
            continue
        x, y = places[str(int(name.split("/")[1]))]
        size = 1.8 * max(numpy.ptp(rows[share > 0.2]), 4.0)
        middle = (share * columns).sum() / share.sum(), (share * rows).sum() / share.sum()
        assert math.dist(middle, (x, y)) < 0.5 * size, (name, middle, (x, y))
        near += 1
    assert near >= 10


@pytest.mark.parametrize("frame", [20, 21])
def test_the_mattes_of_people_add_up_to_the_crowds(rendered, persons, frame):
    mattes, channels, manifests = persons[frame]
    crowd = coverage(channels, "CryptoObject", manifests["CryptoObject"]["Throng sample crowd"])
    assert abs(sum(mattes.values()) - crowd).max() < 2e-3
    assert not any("ThrongPerson" in name for name in channels), "what they were made of is left out"


def test_people_keep_their_mattes_from_frame_to_frame(persons):
    before, after = (persons[frame][0] for frame in (20, 21))
    large = [name for name, share in before.items() if share.sum() > 25.0]
    for name in large:
        grown = numpy.pad(before[name], 4)
        shifted = sum(numpy.roll(grown, (i, j), (0, 1)) for i in range(-4, 5) for j in range(-4, 5))[4:-4, 4:-4]
        assert (after[name] * (shifted > 0.0)).sum() > 0.9 * after[name].sum() > 0.0, name
