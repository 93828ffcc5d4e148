# SPDX-License-Identifier: Apache-2.0
"""People shaped from a library of bodies, without Blender: sizes, levels of detail, clothes, and feet on the ground."""
import pathlib
import sys

import numpy
import pytest

from conftest import ROOT

sys.path.insert(0, str(ROOT / "blender_addon"))
from throng.cast import gait, skinning  # noqa: E402
from throng.people import (casting, hair, library, levels, palettes, person, regions, roster, shape,  # noqa: E402
                           wardrobe)
from throng.people.rig import skinned  # noqa: E402
from throng.people.parts import Part, border_of, clipped, edges_of, folded, normals_of, subdivided  # noqa: E402

EUROPEAN, AFRICAN, ASIAN = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
CROWD = (0, 1, 2)


@pytest.fixture(scope="module")
def loaded(bodies):
    return library.load(pathlib.Path(bodies))


@pytest.fixture(scope="module")
def models(loaded):
    """{(number, level): model} of some of all looks, a child and somebody old among them."""
    found = {}
    for number in (0, 1, 9, 10, 16, 20):
        who = roster.draw_person(roster.LOOKS[number % 6], number)
        maker = person.Maker(loaded, who)
        found.update({(number, level): maker.model(level) for level in CROWD})
    return found


def square(count=4):
    """A flat square of so many cells a side, of side 1."""
    line = numpy.linspace(0.0, 1.0, count + 1)
    x, y = (each.ravel() for each in numpy.meshgrid(line, line))
    points = numpy.stack([x, y, 0.0 * x], axis=1)
    corner = (numpy.arange(count)[:, None] * (count + 1) + numpy.arange(count)).ravel()
    faces = numpy.concatenate([numpy.stack([corner, corner + 1, corner + count + 2], axis=1),
                               numpy.stack([corner, corner + count + 2, corner + count + 1], axis=1)])
    return Part(faces, points, numpy.ones((len(points), 1)), numpy.concatenate([points, points[:, :2]], axis=1))


def area_of(part):
    a, b, c = (part.points[part.faces[:, corner]] for corner in range(3))
    return 0.5 * numpy.cross(b - a, c - a)[:, 2].sum()


def test_cuts_are_exact_and_tagged():
    part = clipped(square(), 0.37 - square().points[:, 0], 7)
    assert abs(area_of(part) - 0.37) < 1e-9 and part.points[:, 0].max() < 0.37 + 1e-9
    assert set(part.tags[numpy.abs(part.points[:, 0] - 0.37) < 1e-9]) == {7} and (part.tags == 7).sum() == 9
    assert numpy.allclose(part.places[:, :3], part.points), "what vertices carry is cut, too"
    assert len(clipped(square(), numpy.full(25, -1.0)).faces) == 0
    diagonal = clipped(square(), 1.0 - square().points[:, :2].sum(axis=1))
    assert abs(area_of(diagonal) - 0.5) < 1e-6


def test_cut_smaller_is_as_large_and_hems_are_strips():
    finer = subdivided(square(), 0.0)
    assert len(finer.faces) == 4 * 32 and abs(area_of(finer) - 1.0) < 1e-9 and edges_of(finer.faces)[1].max() == 2
    hemmed = folded(square(), 0.1)
    assert len(hemmed.faces) == 32 + 2 * 16 and abs(hemmed.points[:, 2].min() + 0.1) < 1e-9


def test_what_is_no_library_is_told(tmp_path):
    (tmp_path / "bodies.npz").write_text("no")
    with pytest.raises(library.LibraryError, match="bodies.npz .*body_library.py"):
        library.load(tmp_path / "bodies.npz")
    with pytest.raises(library.LibraryError, match="cannot be read"):
        library.load(tmp_path / "missing.npz")
    numpy.savez(tmp_path / "later.npz", format=99)
    with pytest.raises(library.LibraryError, match="has the format 99"):
        library.load(tmp_path / "later.npz")


def test_factors_lie_between_two_names():
    rules = {"macrotargets": {"age": {"parts": [{"lowest": -0.01, "highest": 0.5, "low": "child", "high": "young"}]},
                              "height": {"parts": [{"lowest": -0.01, "highest": 0.49, "low": "minheight",
                                                    "high": ""}]}},
             "combinations": {"racegenderage": ["race", "age"], "genderagemuscleweightheight": ["age", "height"]}}
    found = shape.macro_targets(rules, {"age": 0.245, "height": 0.24}, (0.5, 0.0, 0.5))
    assert set(found) == {"macrodetails/african-child", "macrodetails/caucasian-child", "macrodetails/african-young",
                          "macrodetails/caucasian-young", "macrodetails/height/child-minheight",
                          "macrodetails/height/young-minheight"}
    assert found["macrodetails/african-child"] == pytest.approx(0.25) and sum(found.values()) == pytest.approx(1.5)


@pytest.mark.parametrize("years, male, height, ancestry, weight", [
    (6, 1, 1.14, EUROPEAN, 0.5), (9, 0, 1.33, AFRICAN, 0.4), (14, 1, 1.62, ASIAN, 0.5), (30, 0, 1.50, EUROPEAN, 0.9),
    (30, 1, 2.02, AFRICAN, 0.3), (55, 1, 1.74, ASIAN, 0.8), (85, 0, 1.58, EUROPEAN, 0.6)])
def test_people_are_as_tall_as_they_should_be(loaded, years, male, height, ancestry, weight):
    made = shape.shape_of(loaded, shape.Body(years, male, height, ancestry, weight, seed=years))
    body = made[loaded.vertices_of("body"), 2]
    assert abs(body.max() - height) < 0.001 and abs(loaded.joint(made, "ground")[2]) < 0.001
    assert abs(body.min()) < 0.012, "on the ground"


def waist_of(loaded, made):
    """Width and depth together, m, of what hangs on the lower spine."""
    part = loaded.vertices_of("body")
    part = part[loaded.weights[part, loaded.bone["spine_01"]] > 0.5]
    return numpy.ptp(made[part, :2], axis=0).sum()


def test_the_heavy_are_wider_and_children_have_larger_heads(loaded):
    make = lambda **more: shape.shape_of(loaded, shape.Body(**{"years": 30, "male": 1.0, "height": 1.75, **more}))
    waist = lambda made: waist_of(loaded, made)
    assert waist(make(weight=0.95)) > waist(make()) + 0.08 and waist(make()) > waist(make(weight=0.1)) + 0.04
    apart = lambda made: numpy.ptp([loaded.joint(made, f"{side}-shoulder")[1] for side in "lr"])
    assert apart(make(shoulders=1.0)) > apart(make()) + 0.01 > apart(make(shoulders=-1.0)) + 0.02

    def head(made, height):
        return (loaded.joint(made, "head-2")[2] - loaded.joint(made, "neck")[2]) / height

    assert head(make(years=7, height=1.22), 1.22) > 1.08 * head(make(), 1.75)
    faces = [make(seed=seed)[loaded.vertices_of("body")] for seed in (1, 2)]
    assert numpy.abs(faces[0] - faces[1]).max() > 0.004, "everybody has a face of one's own"


def test_levels_have_no_cracks(loaded):
    """A coarser body is open where the full one is, and nowhere else: at the mouth."""
    full = levels.triangles_of(loaded, "body", levels.NEAR)
    open_ones = set(numpy.unique(border_of(full)))
    for level in CROWD:
        triangles = levels.triangles_of(loaded, "body", level)
        assert edges_of(triangles)[1].max() <= 2, "no three faces at one edge"
        assert set(numpy.unique(border_of(triangles))) <= open_ones
        own = levels._regions(loaded, numpy.unique(triangles))
        detail = levels.DETAILS[level]
        assert abs((own == 0).sum() - detail.head) < 0.1 * detail.head + 4, "heads keep a budget of their own"
        assert abs((own == 1).sum() - detail.hands) < 0.15 * detail.hands + 4


def test_triangles_keep_to_their_budget(models):
    for level, middle, most in ((0, 4600, 6000), (1, 1650, 2200), (2, 500, 660)):
        counts = [len(model.faces) for (_, each), model in models.items() if each == level]
        assert numpy.mean(counts) < middle and max(counts) < most, (level, counts)


def test_people_close_to_the_camera_keep_to_their_budget(loaded):
    counts = [len(person.Maker(loaded, who).model(levels.CLOSE).faces)
              for who in (roster.draw_person("casual", number) for number in (0, 1, 9, 10, 16, 20))]
    assert 20_000 < numpy.mean(counts) < 34_000 and max(counts) < 41_000, counts


def test_levels_are_as_large(models):
    for (number, level), model in models.items():
        full = models[number, 0]
        assert numpy.abs(model.points.max(axis=0) - full.points.max(axis=0)).max() < 0.05, (number, level)
        assert numpy.abs(model.points.min(axis=0) - full.points.min(axis=0)).max() < 0.05, (number, level)


def test_models_are_whole(models, loaded):
    for model in models.values():
        assert numpy.isfinite(model.points).all() and numpy.isfinite(model.pattern).all()
        assert model.faces.max() < len(model.points) and set(model.material_of) == set(range(len(model.materials)))
        assert numpy.allclose(model.weights.sum(axis=1), 1.0, atol=2e-3)


@pytest.mark.parametrize("number", (0, 9, 10))
def test_feet_stay_on_the_ground_and_do_not_slide(models, number):
    model = models[number, 0]
    walked, build = gait.gait_of(1.1), model.rig.build
    phases = numpy.linspace(0.12, 0.38, 6)  # the right foot is flat
    posed = model.posed([gait.walk_pose(phase, build, walked) for phase in phases])
    lowest = posed[:, :, 2].min(axis=1)
    assert (lowest > -0.006).all() and (lowest < 0.006).all(), lowest
    foot = model.weights[:, [model.rig.bodies.bone[bone] for bone in ("foot_r", "ball_r")]].sum(axis=1) > 0.99
    moved = posed[:, foot].mean(axis=1)[:, 0] + phases * walked.stride
    assert numpy.ptp(moved) < 0.004, "in the world"


@pytest.mark.parametrize("stride", [1.1, 1.446, 2.4])
def test_legs_bend_as_legs_do(models, stride):
    """Feet alone do not tell: they are where they should be with a knee that bends backwards or a leg back to front."""
    model, walked = models[0, 0], gait.gait_of(stride)
    rig, bone = model.rig, model.rig.bodies.bone
    poses = [gait.walk_pose(phase / 12.0, rig.build, walked) for phase in range(12)]
    matrices = numpy.stack([rig.matrices(pose) for pose in poses])
    at = lambda name, point: matrices[:, bone[name]] @ numpy.append(point, 1.0)
    for side in "rl":
        hip, knee, ankle = (at(f"{name}_{side}", rig.heads[f"{name}_{side}"]) for name in ("thigh", "calf", "foot"))
        along = ankle - hip
        beside = along * ((knee - hip) * along).sum(axis=1, keepdims=True) / (along ** 2).sum(axis=1, keepdims=True)
        assert (knee - hip - beside)[:, 0].min() > -0.002, "knees are before the line from hip to ankle"
        foot = 0 if side == "r" else 1
        meant = numpy.array([pose.feet[foot].ankle for pose in poses])
        assert numpy.abs(ankle[:, [0, 2]] - meant).max() < 1e-6
        for name in ("thigh", "calf", "foot"):
            left = matrices[:, bone[f"{name}_{side}"], :, :3] @ (0.0, 1.0, 0.0)
            assert left[:, 1].min() > 0.9, f"what is left of a {name} stays left of it, or it is back to front"


def test_standing_people_are_as_tall_as_their_bodies(models):
    for number in (0, 9, 16):
        model, who = models[number, 0], roster.draw_person(roster.LOOKS[number % 6], number)
        stands = model.posed([gait.standing_pose("idle", 0.0, model.rig.build)])[0]
        skin = [index for index, name in enumerate(model.materials) if name.startswith("skin")]
        own = numpy.unique(model.faces[numpy.isin(model.material_of, skin)])
        assert abs(stands[own, 2].max() - who.body.height - model.rig.sole) < 0.04


def test_what_clothes_hide_is_not_there(loaded):
    who = roster.draw_person("business", 0)
    parts = person.Maker(loaded, who)._parts(0)
    skin = next(part for part in parts if part.material.startswith("skin"))
    trunk = (skin.places[:, 2] < 0.45) & (skin.places[:, 2] > -0.70) & (skin.places[:, 3] < 0.0)
    assert not trunk.any(), "no skin under a shirt"
    head = skin.places[:, 4] > 0.9
    assert head.sum() > 250, "but heads"


def test_looks_are_drawn_the_same_and_nobody_twice():
    drawn = [roster.draw_person("casual", number) for number in range(64)]
    assert drawn == [roster.draw_person("casual", number) for number in range(64)] and len(set(drawn)) == 64
    assert sum(who.child for who in drawn) >= 3 and sum(who.body.years > 60 for who in drawn) >= 3
    assert 20 < sum(who.body.male for who in drawn) < 44
    assert len({who.hair for who in drawn}) >= 8 and len({who.skin for who in drawn}) >= 5
    assert len({garment for who in drawn for garment in who.garments if garment.kind == "top"}) >= 6
    with pytest.raises(ValueError, match="no look 'beach': expected one of summer"):
        roster.draw_person("beach", 0)


def walkers(**counts):
    """So many of each kind, "look_profile"."""
    return [casting.Walker(0.17 if kind.endswith("child") else 0.22 + 0.06 * (row * 0.618 % 1.0), row % 12,
                           kind.partition("_")[2], kind.partition("_")[0])
            for kind, count in counts.items() for row in range(count)]


def test_casts_have_members_of_every_kind_as_often_as_the_bake():
    people = walkers(casual_=160, summer_child=80, sport_runner=40, business_elderly=3)
    roles = casting.roles_for(people, 16)
    often = [sum((role.look, role.profile) == kind for role in roles)
             for kind in (("casual", ""), ("summer", "child"), ("sport", "runner"), ("business", "elderly"))]
    assert sum(often) == 16 and often[0] >= 7 and 4 <= often[1] <= 5 and 2 <= often[2] <= 3 and often[3] == 1, often
    assert not any(casting.person_of(role).child for role in roles if not role.profile)
    assert len(casting.roles_for(people, 2)) == 2, "fewer members than kinds"
    who = casting.choose(people, roles, 12)
    assert all((roles[member].look, roles[member].profile) == walker.kind for walker, member in zip(people, who))


def pairs_of_twins(look, ordered):
    """The share of pairs within 3 m, of 300 people, who are the same member with the same colour above: of people who
    stand anywhere, and of people who stand in the order that they come in, four abreast."""
    draw = numpy.random.default_rng(5)
    people = [casting.Walker(draw.uniform(0.22, 0.28), int(draw.integers(12)), "", look) for _ in range(300)]
    who = numpy.array(casting.choose(people, casting.roles_for(people, 64), 12))
    colours = palettes.tops(look)
    worn = [colours[int(tint * len(colours))] for tint in draw.random(300)]
    worn = numpy.array([worn.index(colour) for colour in worn])
    row = numpy.arange(300)
    spots = numpy.stack([row // 4 * 1.2, row % 4], axis=1) + draw.normal(0.0, 0.4, (300, 2)) if ordered else \
        draw.uniform(0.0, 19.4, (300, 2))  # 0.8 a square metre
    one, other = numpy.triu_indices(300, 1)
    near = numpy.linalg.norm(spots[one] - spots[other], axis=1) < 3.0
    return ((who[one] == who[other]) & (worn[one] == worn[other]))[near].mean(), numpy.bincount(who, minlength=64)


@pytest.mark.parametrize("look", [*roster.LOOKS, "fans #a01020 #ffffff"])
def test_hardly_anybody_sees_twins(look):
    for ordered in (False, True):
        share, often = pairs_of_twins(look, ordered)
        assert share < (0.0005 if ordered else 0.01), share
        assert often.min() > 0 and often.max() < 13, "everybody of the cast comes, and nobody crowds it"


def test_people_whose_kind_has_no_member_are_of_their_age_and_perhaps_look():
    roles = [roster.Role(0), roster.Role(1, "summer"), roster.Role(0, "casual", "child"),
             roster.Role(2, "winter", "elderly")]
    wanted = {("summer", "runner"): 1, ("sport", "child"): 2, ("summer", "elderly"): 3, ("casual", "adult"): 0}
    for (look, profile), member in wanted.items():
        walker = casting.Walker(0.25, 0, profile, look)
        assert casting.choose([walker], roles, 12) == [member], (look, profile)


def test_profiles_say_how_old_people_are_and_runners_run_in_what_one_runs_in():
    for profile, (youngest, oldest) in roster.AGES.items():
        drawn = [roster.Role(number, "casual", profile).person() for number in range(24)]
        years = [who.body.years for who in drawn]
        assert youngest - 1e-9 <= min(years) and max(years) <= oldest and max(years) - min(years) > 6.0
        assert all(who.child == (profile == "child") and (who.stoop > 0.0) == (profile == "elderly") for who in drawn)
        assert all((who.look, who.bag) == ("sport", "") for who in drawn if profile == "runner")
    role = roster.Role(7, "fans #a01020 #ffffff", "elderly")
    assert roster.Role.of(str(role)) == role and role.person().look == role.look


def test_bakes_tell_who_people_are(tmp_path):
    (tmp_path / "agents.csv").write_text(
        "id,radius,variation,profile,look,colours,overrides\n0,0.25,3,elderly,fans,#a01020 #ffffff,\n"
        "1,0.17,4,,winter,,tint character\n2,0.24,5,ghost,beach,#a01020 #ffffff,tint move\n"
        "3,0.24,5,adult,fans,red white,\n")
    assert casting.read_walkers(tmp_path) == [
        casting.Walker(0.25, 3, "elderly", "fans #a01020 #ffffff"), casting.Walker(0.17, 4, "", "winter", True),
        casting.Walker(0.24, 5), casting.Walker(0.24, 5, "adult", "fans")]
    (tmp_path / "agents.csv").write_text("id,radius,variation\n0,0.17,3\n")
    assert casting.read_walkers(tmp_path) == [casting.Walker(0.17, 3)], "as bakes of old have it"


def test_sticks_are_planted_while_the_left_foot_is(loaded):
    role = next(role for role in (roster.Role(number, "casual", "elderly") for number in range(9))
                if role.person().stick)
    rig, walked = person.Maker(loaded, role.person()).rig, gait.gait_of(1.1)
    poses = [gait.walk_pose(index / 24, rig.build, walked) for index in range(24)]
    tip = numpy.append(rig.stick_at_rest()[0], 1.0)
    tips = numpy.array([rig.matrices(pose)[rig.bodies.bone["Root"]] @ tip for pose in poses])
    assert tips[:, 2].min() > -0.01 and tips[:, 2].max() < 0.06
    flat = [index for index, pose in enumerate(poses) if pose.feet[1].planted == "flat"]
    assert numpy.ptp(tips[flat, 0] + numpy.array(flat) / 24 * walked.stride) < 0.01, "in the world"


def through_legs(bodies, model):
    """The share of a model's hands that are in its legs, in all poses there are."""
    bones = numpy.array(bodies.bones)
    of = lambda *starts: model.weights[:, numpy.char.startswith(bones[:, None], starts).any(axis=1)].sum(axis=1)
    skin = [number for number, name in enumerate(model.materials) if name.startswith("skin")]
    is_skin = numpy.isin(numpy.arange(len(model.points)), model.faces[numpy.isin(model.material_of, skin)])
    hands = is_skin & (of("hand_", "index", "middle", "ring", "pinky", "thumb") > 0.6)
    legs = of("thigh", "calf") > 0.5
    poses = [gait.walk_pose(beat / 12.0, model.rig.build, gait.gait_of(stride))
             for stride in (0.69, 1.13, 1.85, 2.37) for beat in range(0, 12, 2)]
    poses += [gait.standing_pose(clip, beat / 4.0, model.rig.build)
              for clip in gait.STANDING_CLIPS for beat in (0, 2)]
    inside = []
    for points in model.posed(poses):
        away = points[hands][:, None] - points[legs][None]
        near = (away ** 2).sum(axis=2).argmin(axis=1)
        away = away[numpy.arange(len(near)), near]
        normals = normals_of(points, model.faces)[legs][near]
        inside.append(((away * normals).sum(axis=1) < -0.002) & ((away ** 2).sum(axis=1) < 0.06 ** 2))
    return numpy.mean(inside)


def test_hands_pass_beside_legs_in_all_poses(models, loaded):
    for (number, level), model in models.items():
        if level == 0:
            assert through_legs(loaded, model) < 0.005, number


def test_every_look_dresses_women_and_men():
    for look, sexes in wardrobe.LOOKS.items():
        for outfits in sexes:
            assert len(outfits) >= 6, look
            for bottom, tops, shoes in outfits:
                order = wardrobe.order(bottom, tops, shoes)
                kinds = lambda garments: sorted((each.kind, each.material, each.off) for each in garments)
                assert kinds(order) == kinds((bottom, shoes, *tops))
                if bottom.kind == "skirt" and all(top.off <= 0.01 and top.material != bottom.material for top in tops):
                    assert [each.kind for each in order][-1] == "skirt", "blouses and tees are tucked in"


def test_bones_that_never_move_beside_others_are_left_out(models):
    model = models[0, 0]
    rig = model.rig
    walk = gait.gait_of(1.4)
    poses = [gait.walk_pose(index / 6.0, rig.build, walk) for index in range(6)]
    poses += [gait.standing_pose(clip, 0.3, rig.build) for clip in gait.STANDING_CLIPS]
    matrices = numpy.stack([rig.matrices(pose) for pose in poses])
    leaders = skinning.leaders_of(rig.bodies.parents, matrices)[0]
    name = lambda bone: rig.bodies.bones[leaders[rig.bodies.bone[bone]]]
    assert name("index_02_l") == name("hand_l") == "lowerarm_l" and name("clavicle_r") == "spine_03"
    assert all(name(bone) == bone for bone in ("pelvis", "thigh_l", "calf_r", "foot_l", "ball_r", "upperarm_l", "head"))
    points, weights = skinning.hinged(model.points, model.weights, leaders, matrices[::2])
    assert (weights > 0.0).sum(axis=1).max() <= skinning.MOST and numpy.allclose(weights.sum(axis=1), 1.0)
    off = numpy.linalg.norm(skinned(points, weights, matrices[:, numpy.unique(leaders)]) - model.posed(poses), axis=2)
    assert numpy.quantile(off, 0.99) < 1e-3 and off.max() < 5e-3, "where collarbones meet arms, a few millimetres"


def test_turns_and_shares_come_back_from_what_files_keep(models):
    rig = models[0, 0].rig
    matrices = rig.matrices(gait.walk_pose(0.1, rig.build, gait.gait_of(1.4)))
    again = skinning.matrices_of(skinning.turns_of(matrices[..., :3]), matrices[..., 3])
    assert numpy.allclose(again, matrices, atol=1e-9)
    hangs = skinning.hangs_of(numpy.array([[0.0, 1.0, 0.0], [0.25, 0.0, 0.75]]))
    assert hangs.tolist() == [[1.0, 0.0, 0.0, 0.0], [2.0, 0.25, 0.0, 0.0]]


def around(points, middle):
    """(how far round the body, m; height, m; how far out, m)"""
    x, y = points[:, 0] - middle, points[:, 1]
    return numpy.stack([0.15 * numpy.arctan2(y, x), points[:, 2], numpy.hypot(x, y)], axis=1)


def test_tops_fall_outside_of_what_is_worn_below(loaded):
    tried = 0
    for number in range(15):
        who = roster.draw_person(("casual", "summer", "winter")[number % 3], number)
        tops = [each for each in who.garments if each.kind == "top" and each.hem < 0.09 and not each.gap]
        if not tops:
            continue
        parts = person.Maker(loaded, who)._parts(levels.NEAR)
        top = next(part for part in parts if part.material == tops[-1].material)
        for below in (part for part in parts if part.material.startswith("bottom") and len(part.points) > 400):
            height = below.places[:, regions.Z] - tops[-1].hem
            covered = below.points[(height > 0.008) & (height < 0.03)]
            middle = 0.5 * (covered[:, 0].min() + covered[:, 0].max())
            under = around(covered, middle)
            low = top.places[:, regions.Z] - tops[-1].hem < 0.06
            over = around(top.points[low & (top.tags == 0)], middle)  # without hems, turned inwards
            near = ((under[:, None, :2] - over[None, :, :2]) ** 2).sum(axis=2).argmin(axis=1)
            out = under[:, 2] - over[near, 2]
            pokes = (out > 0.001).mean()
            assert pokes < 0.1, (number, tops[-1], below.material, pokes)
            tried += 1
    assert tried > 6


@pytest.mark.parametrize("name", ["short", "bob", "afro", "tail"])
def test_hair_of_people_far_away_lies_over_their_heads(loaded, name):
    """However few points a head has: smoothed, the skin of hair would be drawn into it."""
    who = roster.draw_person("casual", 0)
    body = person.Maker(loaded, who)
    for level in CROWD:
        cap = hair.hair(loaded, body.shape, level, name, "hair black", 1.0, 3)[0]
        below = hair._scalp(loaded, body.shape, level, hair.STYLES[name], False)
        assert len(cap.points) == len(below.points)
        over = ((cap.points - below.points) * below.normals).sum(axis=1)
        grown = regions.scalp(below.places) > 0.03
        assert over[grown].min() > (0.004 if level == 2 else 0.0), (level, over[grown].min())
