# SPDX-License-Identifier: Apache-2.0
"""Characters of one's own: what clips are for, where feet are, and members of a cast in a real Blender."""
import math

import numpy
import pytest

from conftest import ROOT
from results import ADDON, HERE, result_of
from sample_bake import STRIDES, write_bake
from throng import cast
from throng.characters import CharacterError, anatomy, feet, legs, roles

CHARACTERS = ROOT.parent / "shared" / "data" / "characters"
HEEL, TOE = 0.07, 0.17  # walker.py


@pytest.mark.parametrize("name, role", [
    ("Walking_A", "walk"), ("walk_cycle", "walk"), ("Armature|Walk", "walk"), ("WalkCycle", "walk"), ("Idle", "idle"),
    ("HumanArmature|Man_Idle", "idle"), ("Running_B", "run"), ("Jog-Forward", "run"), ("Cheer", "cheer"),
    ("Sit_Chair_Idle", "sit"), ("standing talking 01", "talk"), ("TalkingOnPhone", "phone"),
    ("Idle_LookAround", "look"), ("Walking_Backwards", None), ("Running_Strafe_Left", None), ("2H_Melee_Idle", None),
    ("Jump_Idle", None), ("Death_A", None), ("Clip.001", None), ("Standing Walk Right", None), ("mixamo.com", None),
    ("", None)])
def test_names_say_what_clips_are_for(name, role):
    assert roles.role_of(name)[0] == role


def test_the_plainest_clip_comes_first():
    found = roles.clips_by_role(["Unarmed_Idle", "Sit_Chair_Idle", "Idle_B_Long", "Idle", "Walking_C_Old_Man",
                                 "Walking_A"])
    assert found["idle"][0] == "Idle" and found["idle"][-1] in ("Unarmed_Idle", "Idle_B_Long")
    assert found["walk"] == ["Walking_A", "Walking_C_Old_Man"] and found["sit"] == ["Sit_Chair_Idle"]


def sole_of(stride, stance, down, samples=96, heading=0.0):
    """A flat foot, two points, that walks on the spot."""
    points = numpy.zeros((samples, 2, 3))
    for index in range(samples):
        own = (index / samples - down) % 1.0
        swing = max(0.0, (own - stance) / (1.0 - stance))
        along = 0.5 - own / stance if own < stance else -0.5 + swing * swing * (3.0 - 2.0 * swing)
        points[index, :, 0] = stance * stride * along + numpy.array([-0.07, 0.17])
        points[index, :, 2] = 0.12 * math.sin(math.pi * swing)
    c, s = math.cos(heading), math.sin(heading)
    return points @ numpy.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])


@pytest.mark.parametrize("stride, share, down", [(1.2, 0.6, 0.25), (0.5, 0.7, 0.9), (2.6, 0.3, 0.0)])
def test_stance_and_stride_of_a_known_foot(stride, share, down):
    found = feet.stance_of(sole_of(stride, share, down), 0.007)
    assert found.stride == pytest.approx(stride, rel=0.01)
    assert found.length == pytest.approx(share, abs=0.05)
    assert abs((found.down - down + 0.5) % 1.0 - 0.5) < 0.04


def test_a_foot_that_goes_forwards_on_the_ground_has_no_long_stance():
    found = feet.stance_of(sole_of(1.2, 0.6, 0.25)[::-1], 0.007)
    assert found is None or found.length < 0.15


@pytest.mark.parametrize("degrees", [0, 90, 137, -90])
def test_the_heading_is_where_feet_push_from(degrees):
    pair = [sole_of(1.2, 0.6, down, heading=math.radians(degrees)) for down in (0.0, 0.5)]
    way = feet.heading_of(pair, 0.007)
    assert math.degrees(math.atan2(way[1], way[0])) == pytest.approx(degrees, abs=1.0) and math.hypot(*way) > 0.8


def test_cycles_in_a_clip_are_counted():
    t = numpy.arange(96)[:, None] / 96.0
    for count in (1, 2, 3, 4):
        motion = [numpy.sin(2 * math.pi * count * t), numpy.cos(2 * math.pi * count * t) ** 2]
        assert feet.cycles_in(numpy.concatenate(motion, axis=1)) == count


@pytest.mark.parametrize("stride, share", [(0.7, 0.6), (1.3, 0.6), (2.0, 0.3)])
def test_a_fitted_path_is_planted_without_sliding_and_under_the_body_when_the_cast_expects_it(stride, share):
    points = sole_of(1.2, 0.6, 0.25)
    ankle = points.mean(axis=1) + numpy.array([-0.05, 0.0, 0.08])
    hip = numpy.tile([0.0, 0.0, 0.96], (96, 1))
    foot = feet.foot_of(ankle, points, feet.stance_of(points, 0.007), hip)
    path = feet.fit(foot, stride, share)
    count = len(path.ankle)
    places = [path.ankle[i][0] + (i / count + (1.0 if i / count < 0.28 - share else 0.0)) * stride for i in range(count)
              if path.planted[i]]
    places = [(place + 0.5 * stride) % stride for place in places]
    assert max(places) - min(places) < 0.002
    assert path.ankle[round(0.28 * count)][0] == pytest.approx(0.0, abs=0.012)
    assert abs(sum(path.planted) / count - share) < 0.02
    assert max(numpy.linalg.norm(numpy.diff(path.ankle, axis=0), axis=1)) < 0.1, "no jumps"


def test_legs_bend_forwards_keep_their_length_and_stop_where_they_end():
    hip, knee, ankle = numpy.array([0.0, 0.1, 0.96]), numpy.array([0.02, 0.1, 0.51]), numpy.array([0.0, 0.1, 0.08])
    for target in ([0.3, 0.1, 0.2], [-0.4, 0.12, 0.2], [0.0, 0.1, 0.6], [0.0, 0.1, -0.5]):
        upper, lower, reached = legs.bend(hip, knee, ankle, numpy.array(target))
        bent = (upper @ [*knee, 1.0])[:3]
        assert numpy.allclose((lower @ [*knee, 1.0])[:3], bent, atol=1e-9)
        assert numpy.allclose((lower @ [*ankle, 1.0])[:3], reached, atol=1e-9)
        assert numpy.allclose((upper @ [*hip, 1.0])[:3], hip, atol=1e-9)
        assert numpy.linalg.norm(bent - hip) == pytest.approx(numpy.linalg.norm(knee - hip))
        assert numpy.linalg.norm(reached - bent) == pytest.approx(numpy.linalg.norm(ankle - knee))
        if target[2] > 0.0:
            assert numpy.allclose(reached, target, atol=1e-9)
            assert numpy.cross(bent - hip, reached - bent)[1] > -1e-9, "the knee bends forwards"
        else:
            assert reached[2] > 0.0


def test_a_model_without_two_feet_is_refused():
    points = numpy.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    with pytest.raises(CharacterError, match="no two feet"):
        anatomy.find_legs(["a", "b"], [-1, 0], numpy.array([[0.0, 0.0, 0.5], [0.0, 0.0, 0.1]]), points,
                          numpy.array([1, 0]))


def slide_of(sole, stride):
    """Metres that what is on the ground goes there, in one stance of a foot (K, V, 3). By the test's own reckoning:
    vertices within 4 mm of the ground in two poses that follow each other."""
    count, slid, carried = len(sole), 0.0, 0
    for index in range(count):
        now, then = sole[index], sole[(index + 1) % count] + numpy.array([stride / count, 0.0, 0.0])
        touching = (now[:, 2] < 0.004) & (then[:, 2] < 0.004)
        if touching.any():
            slid += float(numpy.linalg.norm((then - now)[touching, :2], axis=1).min())
            carried += 1
    return slid, carried / count


def check_feet(positions, strides, least_carried):
    """Planted feet stay, are on the ground, and are under the body at the shipped cast's phase, right foot first."""
    positions = numpy.array(positions)
    for index, stride in enumerate(strides):
        cycle = positions[index * cast.POSES:(index + 1) * cast.POSES]
        for side, phase in ((0, cast.gait.UNDER_BODY), (1, cast.gait.UNDER_BODY + 0.5)):
            sole = cycle[:, side]
            slid, carried = slide_of(sole, stride)
            assert slid < 0.02 and carried > least_carried, (stride, side, slid, carried)
            assert sole[..., 2].min() > -0.006, "not through the ground"
            place = phase * cast.POSES
            share = place - int(place)
            under = (1.0 - share) * sole[int(place)] + share * sole[int(place) + 1]
            assert under[:, 2].min() < 0.005
            middle = 0.5 * (under[:, 0].min() + under[:, 0].max())
            assert middle == pytest.approx(0.5 * (TOE - HEEL), abs=0.02), "the ankle is under the body"
            assert (under[:, 1] < 0.0).all() == (side == 0), "right foot first"


@pytest.fixture(scope="module")
def joined(blender, tmp_path_factory):
    """What check_characters.py has seen."""
    folder = tmp_path_factory.mktemp("characters")
    write_bake(folder / "bake")
    return result_of(blender(HERE / "check_characters.py", ADDON, HERE, folder / "bake", folder))


REFUSED = {"words.glb": "not a glTF", "half.glb": "truncated", "empty.gltf": "no skeleton",
           "absent.glb": "cannot be read", "no clip of that name": "no clip Stroll",
           "no such member": "no 13 to replace", "too many vertices": "takes up to 892",
           "walks backwards only": "no clip walks", "no clips": "has no clips", "no walk": "no clip walks",
           "no size": "no height", "no meshes": "no mesh hangs", "no armature": "no armature",
           "not a character": "no character that was added"}


def test_what_cannot_join_is_refused_in_clear_words(joined):
    assert set(joined["errors"]) == set(REFUSED)
    for label, expected in REFUSED.items():
        said = joined["errors"][label]
        assert expected in said and "Traceback" not in said, said


def test_a_file_joins_and_leaves_nothing_but_a_member(joined):
    assert joined["members"] == [["walker", True]]
    lists = joined["left"]["objects"] - 2 * cast.LEVELS  # from 4.0 on lists of poses are of four people each
    assert lists in (0, 1)
    # the nodes of level 2, which has fewer poses
    left = {"objects": 2 * cast.LEVELS + lists, "meshes": 2 * cast.LEVELS + lists, "materials": 1, "images": 1,
            "actions": 0, "armatures": 0, "scenes": 0, "collections": 0, "node_groups": 1 + lists}
    assert joined["left"] == left
    assert joined["look"] == {"materials": ["Walker cloth"], "uv": 1, "packed": True}


def test_clips_are_found_and_told(joined):
    report = "\n".join(joined["report"])
    assert "1.70 m (scaled by 1)" in report and ("looks -180" in report or "looks 180" in report)
    assert "stride 1.00 m: walk_cycle (its own: 1.20 m)" in report and "Walking_Fast (its own: 1.70 m)" in report
    assert "Walking_Fast: holds 2 cycles" in report and "Walking_Fast: goes 1.70 m a cycle" in report
    assert "Backwards" not in report
    assert "idle = Idle" in report and "left out, because hands hold it: Walker stick" in report


def test_planted_feet_stay_on_the_ground(joined):
    check_feet(joined["feet"], STRIDES, 0.4)
    assert joined["velocity"] < 1e-4 and joined["still"] == 0.0
    assert joined["standing_height"] == pytest.approx(1.7, abs=0.01)


def test_a_member_is_shown_by_its_share_at_all_levels(joined):
    shown = joined["shown"]
    assert 2 <= shown["8"] <= sum(shown.values()) * 0.3 and len(shown) == 9
    for level, share in (("1", 3.0), ("2", 10.0)):
        count, triangles, there = joined["levels"][level]
        assert count == shown["8"] and there == cast.Repertoire(tuple(STRIDES)).poses(int(level))
        assert triangles * share == pytest.approx(joined["levels"]["finest"], rel=0.1)
    assert joined["after_reload"] == joined["shown_far"] == joined["shown_again"] == shown
    assert not any(joined["left_by_levels"].values())
    assert joined["without_add_on"].get("8", 0) > 0


def test_an_armature_of_the_scene_replaces_a_member_until_it_is_removed(joined):
    second = joined["second"]
    report = "\n".join(second["report"])
    assert "their feet were asked" in report and "Clip.001 (its own: 1.22 m)" in report
    assert "idle = Clip.002" in report and "looks 90" in report
    assert second["count"] == cast.Repertoire(tuple(STRIDES)).count
    assert second["vertices"] == 14 * 150 and second["smooth"]
    assert joined["scenes"] == [0, 0]
    check_feet(numpy.array(joined["second_feet"]) * (1.7 / 1.6), numpy.array(STRIDES) * (1.7 / 1.6), 0.4)
    assert joined["restored"] == ["Throng person 02", False] and joined["at_the_end"] == [8, 7]


def test_clips_strides_and_height_are_the_users_where_they_say_so(joined):
    said = "\n".join(joined["said"])
    assert "2.50 m" in said and "walk_cycle (its own: 1.50 m)" in said and "idle = Jump_Idle" in said


@pytest.mark.parametrize("name", ["Mage", "Rogue"])
def test_downloaded_characters_walk_without_sliding(blender, tmp_path, name):
    if not (CHARACTERS / f"{name}.glb").exists():
        pytest.skip(f"{CHARACTERS / name}.glb is not there: these characters do not come with the project")
    write_bake(tmp_path / "bake")
    script = tmp_path / "join.py"
    script.write_text("""
import bpy, json, sys
addon, bake, model = sys.argv[-3:]
sys.path.insert(0, addon)
import throng
bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
bpy.ops.import_scene.throng(filepath=bake + "/bake.json", scenery=False, camera=False)
assert bpy.ops.throng.add_character(filepath=model) == {"FINISHED"}
from throng.characters.members import report_of
from throng.crowd.queries import crowd_objects, figure
crowd = crowd_objects(bpy.context.scene)[0]
from throng.cast.sheets import points_of
mesh = figure(crowd, 8).data
print("RESULT " + json.dumps({"report": report_of(crowd, 8), "poses": points_of(figure(crowd, 8)).shape[:2],
                              "materials": [material.name for material in mesh.materials],
                              "vertices": len(mesh.vertices),
                              "smooth": sum(p.use_smooth for p in mesh.polygons) / len(mesh.polygons)}))
""")
    found = result_of(blender(script, ADDON, tmp_path / "bake", CHARACTERS / f"{name}.glb"))
    report = "\n".join(found["report"])
    slides = [float(line.split("slides ")[1].split(" cm")[0]) for line in found["report"] if "slides" in line]
    assert len(slides) == len(STRIDES) and max(slides) < 2.0
    assert "looks -90" in report and "1.75 m" in report and "idle = Idle" in report
    assert "Walking_" in report and "Backwards" not in report
    assert "left out, because hands hold it" in report and found["vertices"] > 100
    assert found["smooth"] > 0.5
    assert found["materials"] == [f"{name.lower()}_texture"]
    assert found["poses"] == [cast.Repertoire(tuple(STRIDES)).count, found["vertices"]]
