# SPDX-License-Identifier: Apache-2.0
"""How faces of people close to the camera move: lids, mouths and eyes, of whomever, with beards and lashes on them."""
import pathlib
import sys

import numpy
import pytest

from conftest import ROOT

sys.path.insert(0, str(ROOT / "blender_addon"))
from throng.people import faces, levels, library, person, roster  # noqa: E402
from throng.people.parts import normals_of  # noqa: E402

PEOPLE = (0, 1, 3, 9, 10)  # a child and somebody old among them


@pytest.fixture(scope="module")
def loaded(bodies):
    return library.load(pathlib.Path(bodies))


@pytest.fixture(scope="module")
def models(loaded):
    return {number: person.Maker(loaded, roster.Role(number).person()).model(levels.CLOSE) for number in PEOPLE}


@pytest.fixture(scope="module")
def shapes(loaded):
    """{number: (shape, {expression: how it moves})} of the library's vertices."""
    makers = {number: person.Maker(loaded, roster.Role(number).person()) for number in PEOPLE}
    return {number: (maker.shape, faces.moves_of(loaded, maker.person.body, maker.shape))
            for number, maker in makers.items()}


def test_lids_meet_before_the_eye(loaded, shapes):
    for shape, moves in shapes.values():
        skin = loaded.vertices_of("body")
        for side in "lr":
            ball = shape[loaded.vertices_of(f"helper-{side}-eye")]
            before = skin[(numpy.abs(shape[skin, 1] - ball[:, 1].mean()) < 0.0035)
                          & (numpy.abs(shape[skin, 2] - ball[:, 2].mean()) < 0.012)
                          & (shape[skin, 0] > ball[:, 0].max() - 0.003)]
            upper = before[moves["lids"][before, 2] < -0.003]
            lower = before[~moves["lids"][before].any(axis=1) & (shape[before, 2] < shape[upper, 2].min())]
            shut = shape + moves["lids"]
            opened, closed = (points[upper, 2].min() - points[lower, 2].max() for points in (shape, shut))
            assert 0.004 < opened < 0.012 and -0.002 < closed < 0.0005
            assert shut[upper, 0].min() > ball[:, 0].max() - 0.001, "over the ball, not through it"


def test_mouths_open_below_and_nothing_else_moves(loaded, shapes):
    for shape, moves in shapes.values():
        mouth, crown = loaded.joint(shape, "mouth"), shape[:, 2].max()
        for name, low, high in (("mouth", -0.13, 0.06), ("lids", 0.02, 0.13), ("smile", -0.05, 0.09)):
            moving = numpy.abs(moves[name]).max(axis=1) > 1e-3
            moving &= numpy.isin(numpy.arange(len(shape)), loaded.vertices_of("body"))
            assert moving.sum() > 50
            away = (shape[moving, 2] - mouth[2]) / (crown / 1.75)
            assert low < away.min() and away.max() < high, name
        assert moves["mouth"][:, 2].min() < -0.01, "chins go down"


def test_everything_on_a_face_goes_with_it(loaded, models):
    """Lashes and teeth, and beards on chins."""
    for model in models.values():
        kinds = numpy.array(model.materials)[model.material_of]
        for kind, name in (("lashes", "lids"), ("teeth", "mouth")):
            used = numpy.unique(model.faces[numpy.char.startswith(kinds, kind)])
            assert len(used) and numpy.abs(model.moves[name][used]).max() > 0.003
    bearded = next(who for who in (roster.Role(number).person() for number in range(60)) if who.beard == "full")
    model = person.Maker(loaded, bearded).model(levels.CLOSE)
    kinds = numpy.array(model.materials)[model.material_of]
    chin = model.points[:, 2] < model.points[numpy.unique(model.faces[kinds == "teeth"]), 2].min() - 0.015
    hairy = numpy.char.startswith(kinds, "hair") | numpy.char.startswith(kinds, "grey")
    hairs = numpy.unique(model.faces[hairy])
    hairs = hairs[chin[hairs] & (model.points[hairs, 0] > model.points[hairs, 0].max() - 0.02)]
    assert len(hairs) > 10 and numpy.median(model.moves["mouth"][hairs, 2]) < -0.01


def test_eyes_are_balls_that_nothing_else_moves(models):
    for model in models.values():
        ball = numpy.linalg.norm(model.moves[faces.BALL], axis=1)
        eyes = ball > 0.0
        assert 0.010 < ball[eyes].min() and ball[eyes].max() < 1.12 * ball[eyes].min()
        kinds = numpy.array(model.materials)[model.material_of]
        assert eyes.sum() == len(numpy.unique(model.faces[numpy.char.startswith(kinds, "eyes")]))


def test_skin_is_not_turned_over_by_what_moves(models):
    for model in models.values():
        kinds = numpy.array(model.materials)[model.material_of]
        skin = model.faces[numpy.char.startswith(kinds, "skin")]
        rest = normals_of(model.points, skin)
        for name, most in (("mouth", 0.3), ("smile", 1.0)):
            moved = normals_of(model.points + most * model.moves[name], skin)
            outside = regions_outside(model)
            assert (rest * moved).sum(axis=1)[outside].min() > 0.2, name


def regions_outside(model):
    """Vertices of skin below the lips, where light would show it."""
    ahead, left, up = model.pattern.T
    return (up > 0.60) & (up < 0.645) & (numpy.abs(left) < 0.04) & (ahead > 0.12) & (
        numpy.abs(model.moves["mouth"]).max(axis=1) > 0.0)


def test_only_those_who_are_seen_closely_have_faces_that_move(loaded):
    maker = person.Maker(loaded, roster.Role(1).person())
    assert not maker.model(0).moves and set(maker.model(levels.NEAR).moves) == {*faces.EXPRESSIONS, faces.BALL}


def test_close_people_have_few_thin_triangles(loaded):
    def thin(triangles):
        corners = loaded.vertices[triangles]
        longest = numpy.linalg.norm(corners[:, [1, 2, 0]] - corners, axis=2).max(axis=1)
        area = numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        return int((area < 0.08 * longest ** 2).sum())

    made = levels.triangles_of(loaded, "body", levels.CLOSE)
    assert thin(made) < 20
    # a square whose long side has a corner on it
    points = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.52, 0]], float)
    triangles = numpy.array([[0, 2, 4], [0, 1, 2], [2, 3, 4], [3, 0, 4]])
    found = levels.without_slivers(points, triangles)
    assert sorted(map(sorted, found.tolist())) == [[0, 1, 4], [0, 3, 4], [1, 2, 4], [2, 3, 4]]
    assert (normals_of(points, found)[:, 2] > 0.99).all()
