# SPDX-License-Identifier: Apache-2.0
"""People near the camera: they are not given one of the poses that there are, as all others are (instancer.py), but
bent into the very pose of the moment. Natively, as playback is: nodes only, no Python when frames change.

A picked pose stands for a whole 24th of a cycle: from near, feet stick to a moment and then jump, and whoever stops
jumps from one pose to another. Here bones are worked out first, a few points for each person: blended between two poses
of the walk, between two beats of how somebody stands, and between walking and standing by how fast the person is; then
turned and put where the person is. After that all vertices follow the bones that they hang on (cast/bones.py).

What comes out is one mesh, and what the people's points say of them (`tint`, and in `throng_row` the number that
`id` is elsewhere) is on its vertices. It has a
`velocity`, for the whole way of every vertex, so it blurs though it is another mesh in every frame.

On the screen, where time is short, only those within some metres have meshes as fine as final pictures have, and
everybody who is further away than some more takes the poses of the coarsest: Blender goes over all poses that a crowd
could show in every frame, shown or not.

Who is near, a modifier files away on the points: whoever is within so many metres before the camera. Where these are
more than there may be, the distance shrinks, by sixteenths, until they are not. The nearest of them can have meshes
of more detail in final pictures (close.py).
"""
import bpy

from ..blender.nodes import Maths, drop_object, new_tree, objects_read, own_tree, socket
from ..blender.vectors import between, combined, parts, scaled, vector
from ..cast import BEATS, POSES, bones, library
from ..cast.sheets import sheet_of
from ..formats import FEET
from . import close, faces, heads, legs, poses, trunks
from .bent_bones import BentBones
from .names import BIGGER, BONE, COARSE, GROUND, HIDDEN, LEVEL, NATURE, NEAR, ROW, WHO
from .own import FIRST, OWN

MODIFIER = "throng near"
HALVINGS = 4           # of the distance: 16 steps
STANDS_BELOW = 0.03    # m/s: where no stream tells it, slower people stand, those faster than WALKS_FROM walk, and
WALKS_FROM = 0.35      # between them both are blended
COARSER_FROM = (4.5, 9.0)  # m: on the screen, near people who are further away have meshes of level 1, and 2,
PICKED_COARSER_FROM = 30.0  # m: and from here on all others those of level 2
_GEOMETRY = [("Geometry", "NodeSocketGeometry")]
_ALL, _JOINTS, _REST = "throng_all_bones", "throng_all_joints", "throng_rest"  # marks of objects in the cast
_RANK, _TURN = "throng_rank", "throng_turn"
_DETAIL = "throng_detail"  # 0 for the near level, 1 and 2 for the coarser ones of the screen, 3 for close people's
_SLOTS = 6  # poses that somebody is between: two of the walk, two of the gait before, two beats
_WALKS, _BEFORE, _STANDS, _RATES = "throng_walks", "throng_before", "throng_stands", "throng_rates"


def selection_tree():
    """The modifier's nodes: who is near."""
    name = "Throng near, close, coarse and coarsest by distance"
    found = own_tree(name)
    if found:
        return found
    tree, inputs, outputs = new_tree(name, _GEOMETRY + [("Camera", "NodeSocketObject"), ("Reach", "NodeSocketFloat"),
                                                        ("Most", "NodeSocketInt"), ("Close", "NodeSocketFloat"),
                                                        ("Whole", "NodeSocketBool")],
                                    _GEOMETRY)
    maths, given = Maths(tree), inputs.outputs
    camera = maths.node("GeometryNodeObjectInfo", transform_space="RELATIVE")
    maths.link(given["Camera"], camera.inputs["Object"])
    place = maths.node("GeometryNodeInputPosition").outputs[0]
    away = vector(maths, "SUBTRACT", place, camera.outputs["Location"])
    looks = maths.node("ShaderNodeVectorRotate", rotation_type="EULER_XYZ")
    looks.inputs["Vector"].default_value = (0.0, 0.0, -1.0)
    maths.link(camera.outputs["Rotation"], looks.inputs["Rotation"])
    ahead = maths.math("GREATER_THAN", vector(maths, "DOT_PRODUCT", away, looks.outputs[0]), -1.0)
    alive = maths.math("GREATER_THAN", maths.components("throng_state")[0], 0.5)
    there = maths.math("MULTIPLY", maths.math("SUBTRACT", alive, maths.attribute(HIDDEN)), ahead)
    distance = vector(maths, "LENGTH", away)
    share = maths.math("DIVIDE", distance, given["Reach"])
    # who is not there is beyond all reach
    share = maths.math("MULTIPLY_ADD", maths.math("SUBTRACT", 1.0, there), 2.0, share)
    points = maths.store(given["Geometry"], NEAR, share)
    share = maths.attribute(NEAR)
    near = maths.math("LESS_THAN", share, fitting(maths, points, share, given["Most"]))
    closer = maths.math("SUBTRACT", 1.0, maths.math("DIVIDE", distance, maths.math("MAXIMUM", given["Close"], 1e-3)))
    near = maths.math("MULTIPLY", near, maths.math("ADD", maths.math("MAXIMUM", closer, 0.0), 1.0))
    first, second, third = (maths.math("GREATER_THAN", distance, each) for each in (*COARSER_FROM, PICKED_COARSER_FROM))
    coarse = maths.math("ADD", maths.math("ADD", first, second), third)
    points = maths.store(points, COARSE, maths.math("MULTIPLY", coarse, maths.math("SUBTRACT", 1.0, given["Whole"])))
    maths.link(maths.store(points, NEAR, near), outputs.inputs[0])
    return tree


def fitting(maths, points, share, most):
    """The largest of even steps from 0 to 1 that at most so many points' shares are below, found by halves."""
    found, halves = 0.0, [0.5 ** number for number in range(1, HALVINGS + 1)]
    for step in (*halves, halves[-1]):  # the last step again: all of the way is one, too
        fits = _fits(maths, points, share, maths.math("ADD", found, step), most)
        found = maths.math("MULTIPLY_ADD", fits, step, found)
    return found


def _fits(maths, points, share, below, most):
    """1 where at most so many points' shares are below something."""
    count = maths.node("GeometryNodeAttributeStatistic", data_type="FLOAT", domain="POINT")
    maths.link(points, count.inputs["Geometry"])
    maths.link(maths.math("LESS_THAN", share, below), socket(count.inputs, "Attribute"))
    return maths.math("LESS_THAN", socket(count.outputs, "Sum"), maths.math("ADD", most, 0.5))


def bones_for(crowd, cast):
    """The object of the bones of all members that can be bent, where a crowd bends who is near; or None."""
    figures = boned_members(cast) if MODIFIER in crowd.modifiers else []
    if not figures:
        return None
    sheets = [sheet_of(figure) for figure in figures]
    joined = next((thing for thing in cast.objects if _ALL in thing), None)
    # of members who were made anew there are others of the same name
    if joined and [sheet.name for sheet in sheets] == list(joined[_ALL]) \
            and objects_read(joined.modifiers[0].node_group) == set(sheets):
        return joined
    _drop_bones(cast)
    joined, joints = bones.join_sheets(f"{cast.name} bones", sheets), bones.joints_of(f"{cast.name} joints", sheets)
    joined[_ALL], joints[_JOINTS] = [sheet.name for sheet in sheets], True
    for thing in (joined, joints):
        cast.objects.link(thing)
    return joined


def _drop_bones(cast):
    for thing in [each for each in cast.objects if _ALL in each or _JOINTS in each]:
        drop_object(thing)


def forget(cast, crowds):
    """Throws away what only near people need, where no crowd of the cast has any."""
    if any(MODIFIER in crowd.modifiers for crowd in crowds):
        return
    for thing in [each for each in cast.objects if _REST in each]:
        bpy.data.objects.remove(thing)
    close.forget(cast)
    _drop_bones(cast)


def boned_members(cast):
    """Figures of level 0 that keep bones, from member 0 on; all have as many poses and bones as the first."""
    figures, found = library.figures_of(cast), []
    while (0, len(found)) in figures and bones.has_bones(sheet_of(figures[0, len(found)])):
        figure = figures[0, len(found)]
        if found and _size(figure) != _size(found[0]):
            break
        found.append(figure)
    return found


def _size(figure):
    sheet = sheet_of(figure)
    return len(sheet.data.vertices), sheet["throng_bones"]


def _walks(maths, state, phase, repertoire):
    """(a pose of the walk, the one after it, how far between them), the same of the gait before, but how much of that
    is left, and the gait (docs/bake.md has how the state tells all this)."""
    all_ = maths.math("MULTIPLY", maths.math("FRACT", state), 16.0)
    gait = maths.math("ROUND", all_)
    rest = maths.math("MULTIPLY_ADD", maths.math("SUBTRACT", all_, gait), 32.0, 1e-3)
    before, left = maths.math("FLOOR", rest), maths.math("FRACT", rest)
    place = maths.math("MULTIPLY", maths.math("FRACT", phase), float(POSES))
    pose = maths.math("MINIMUM", maths.math("FLOOR", place), POSES - 1.0)
    after = maths.math("MODULO", maths.math("ADD", pose, 1.0), float(POSES))
    found = []
    for each, share in ((gait, maths.math("SUBTRACT", place, pose)), (before, maths.smooth(left, 0.0, 1.0))):
        number = maths.math("SUBTRACT", each, float(repertoire.first))
        number = maths.math("MINIMUM", maths.math("MAXIMUM", number, 0.0), len(repertoire.strides) - 1.0)
        first = maths.math("MULTIPLY", number, float(POSES))
        found.append(combined(maths, maths.math("ADD", first, pose), maths.math("ADD", first, after), share))
    return (*found, gait)


def _stands(maths, state, nature, walking):
    """(a beat of how somebody stands, the one after it, how far between them): as poses.py picks them, but people
    take a third of the time for each change."""
    gathers = maths.math("COMPARE", maths.math("FLOOR", state), 2.0, 0.1)
    clip = maths.math("MODULO", nature[0], maths.math("MULTIPLY_ADD", gathers, 2.0, 2.0))
    frame = socket(maths.node("GeometryNodeInputSceneTime").outputs, "Frame")
    rounds = maths.math("ADD", nature[1], maths.math("DIVIDE", frame, poses.FRAMES_A_ROUND))
    place = maths.math("MULTIPLY", maths.math("FRACT", rounds), float(BEATS))
    beat = maths.math("FLOOR", place)
    first = maths.math("MULTIPLY_ADD", clip, float(BEATS), float(walking))
    after = maths.math("MODULO", maths.math("ADD", beat, 1.0), float(BEATS))
    return combined(maths, maths.math("ADD", first, beat), maths.math("ADD", first, after),
                    maths.smooth(maths.math("SUBTRACT", place, beat), 0.67, 1.0))


def _rests(maths, state, phase, nature, repertoire):
    """The same of whoever does not walk, in a seat or not."""
    stands = _stands(maths, state, nature, repertoire.walking())
    if not repertoire.clips:
        return stands
    first, along, count, returns = poses.seated_place(maths, state, phase, repertoire.clips)
    first = maths.math("ADD", first, float(repertoire.upright()))
    last = maths.math("SUBTRACT", count, maths.math("ADD", returns, 1.0))  # there and back, the last is only gone to
    pose = maths.math("MINIMUM", maths.math("FLOOR", along), last)
    after = maths.math("MODULO", maths.math("ADD", pose, 1.0), count)
    sits = combined(maths, maths.math("ADD", first, pose), maths.math("ADD", first, after),
                    maths.math("SUBTRACT", along, pose))
    return between(maths, stands, sits, poses.has_seat(maths, state))


def _people(maths, points, repertoire, cast, is_told):
    """Points of near people with all that their bones need to know of them. @param is_told by a stream, how much of
    the walk is in their poses"""
    cosine, sine, speed = maths.components("throng_dir")
    state, variation, phase = maths.components("throng_state")
    nature = maths.components(NATURE)
    who = poses.member_in(maths, cast, variation)
    walks, before, gait = _walks(maths, state, phase, repertoire)
    stride = None
    for number, length in enumerate(repertoire.strides, repertoire.first):
        part = maths.math("MULTIPLY", maths.math("COMPARE", gait, float(number), 0.5), float(length))
        stride = part if stride is None else maths.math("ADD", stride, part)
    walking = trunks.walking(maths) if is_told else maths.smooth(speed, STANDS_BELOW, WALKS_FROM)
    rate = maths.math("DIVIDE", maths.math("MULTIPLY", speed, float(POSES)), maths.math("MAXIMUM", stride, 0.1))
    for name, value, kind in ((WHO, who, "INT"), (_RANK, maths.node("GeometryNodeInputIndex").outputs[0], "INT"),
                              (ROW, maths.node("GeometryNodeInputID").outputs[0], "INT"),
                              (_WALKS, walks, "FLOAT_VECTOR"), (_BEFORE, before, "FLOAT_VECTOR"),
                              (_STANDS, _rests(maths, state, phase, nature, repertoire), "FLOAT_VECTOR"),
                              (_RATES, combined(maths, walking, rate, speed), "FLOAT_VECTOR"),
                              (_TURN, combined(maths, cosine, sine, maths.math("ADD", maths.attribute(BIGGER), 1.0)),
                               "FLOAT_VECTOR")):
        points = maths.store(points, name, value, kind)
    return points


def _poses_between(maths, people, sheet, pose_count, bone_count):
    """A point for each bone of each of the _SLOTS poses that somebody is between, as the sheet has it: all that a
    person needs of the sheet, in little room: a node that samples goes over all that it samples from, in every
    frame."""
    people = _without(maths, people, _RATES, _TURN, _RANK, ROW)
    copies = maths.node("GeometryNodeDuplicateElements", domain="POINT")
    maths.link(people, copies.inputs["Geometry"])
    copies.inputs["Amount"].default_value = _SLOTS * bone_count
    number = copies.outputs["Duplicate Index"]
    slot = maths.math("FLOOR", maths.math("DIVIDE", maths.math("ADD", number, 0.5), float(bone_count)))
    bone = maths.math("SUBTRACT", number, maths.math("MULTIPLY", slot, float(bone_count)))
    pose = 0.0
    for first, name in enumerate((_WALKS, _BEFORE, _STANDS)):
        for second, value in enumerate(maths.components(name)[:2]):
            pose = maths.math("MULTIPLY_ADD", maths.math("COMPARE", slot, 2.0 * first + second, 0.5), value, pose)
    pose = maths.math("MULTIPLY_ADD", maths.attribute(WHO, "INT"), float(pose_count), pose)
    at = maths.math("MULTIPLY_ADD", pose, float(bone_count), bone)
    points = maths.store(copies.outputs["Geometry"], BONE, at, "INT")
    index = maths.attribute(BONE, "INT")
    points = _filed(maths, points, _COLUMNS, [bones.sample(maths, sheet, maths.attribute(name, "FLOAT_VECTOR"), index)
                                              for name in "xy"])
    put = maths.node("GeometryNodeSetPosition")
    maths.link(points, put.inputs["Geometry"])
    maths.link(bones.sample(maths, sheet, maths.node("GeometryNodeInputPosition").outputs[0], index),
               put.inputs["Position"])
    return put.outputs[0]


def _blended(maths, poses, at, name):
    """(a column of everybody's bones between all six poses, how fast it changes in a second); `name` "" is where they
    are. @param poses as _poses_between() has them; @param at (slot) is where there"""
    value = maths.attribute(name, "FLOAT_VECTOR") if name else maths.node("GeometryNodeInputPosition").outputs[0]
    here, after, was, was_after, stand, stand_after = (bones.sample(maths, poses, value, at(slot))
                                                       for slot in range(_SLOTS))
    walks, before, stands = (maths.components(each)[2] for each in (_WALKS, _BEFORE, _STANDS))
    walking, rate, _ = maths.components(_RATES)
    here, after = between(maths, here, was, before), between(maths, after, was_after, before)
    walk = between(maths, here, after, walks)
    change = scaled(maths, vector(maths, "SUBTRACT", after, here), maths.math("MULTIPLY", walking, rate))
    return between(maths, between(maths, stand, stand_after, stands), walk, walking), change


def _placed(maths, value):
    """A vector of somebody's own frame, in the scene's: along the ground's slope, turned, and as large as they are."""
    x, y, z = parts(maths, value)
    along, across, _ = maths.components(GROUND)
    z = maths.math("MULTIPLY_ADD", x, along, maths.math("MULTIPLY_ADD", y, across, z))
    cosine, sine, size = maths.components(_TURN)
    turned = combined(maths, maths.math("SUBTRACT", maths.math("MULTIPLY", x, cosine), maths.math("MULTIPLY", y, sine)),
                      maths.math("MULTIPLY_ADD", x, sine, maths.math("MULTIPLY", y, cosine)), z)
    return scaled(maths, turned, size)


_COLUMNS = ("throng_x", "throng_y", "throng_z")
_CHANGES = ("throng_x_changes", "throng_y_changes", "throng_z_changes", "throng_changes")


def _bone_points(maths, people, sheet, blurs, pose_count, bone_count):
    """A point for each bone of everybody: where it takes what hangs on it is its place; what it makes of x, y and z is
    in attributes, and where pictures blur, how fast all four change. What poses have is filed away first: an attribute
    works out anew whatever it is made of."""
    copies = maths.node("GeometryNodeDuplicateElements", domain="POINT")
    maths.link(people, copies.inputs["Geometry"])
    copies.inputs["Amount"].default_value = bone_count
    points = maths.store(copies.outputs["Geometry"], BONE, copies.outputs["Duplicate Index"], "INT")
    first = maths.math("MULTIPLY_ADD", maths.attribute(_RANK, "INT"), float(_SLOTS * bone_count),
                       maths.attribute(BONE, "INT"))
    at = lambda slot: maths.math("ADD", first, float(slot * bone_count))
    poses = _poses_between(maths, people, sheet, pose_count, bone_count)
    blended, changes = zip(*(_blended(maths, poses, at, name) for name in (*_COLUMNS[:2], "")))
    put = maths.node("GeometryNodeSetPosition")
    maths.link(points, put.inputs["Geometry"])
    here = maths.node("GeometryNodeInputPosition").outputs[0]
    maths.link(vector(maths, "ADD", _placed(maths, blended[2]), here), put.inputs["Position"])
    points = _filed(maths, put.outputs[0], _COLUMNS, blended[:2])
    x, y = (maths.attribute(name, "FLOAT_VECTOR") for name in _COLUMNS[:2])
    x = vector(maths, "NORMALIZE", x)
    points = _filed(maths, points, _COLUMNS, [x])
    y = vector(maths, "SUBTRACT", y, scaled(maths, x, vector(maths, "DOT_PRODUCT", x, y)))
    points = _filed(maths, points, _COLUMNS[1:], [vector(maths, "NORMALIZE", y)])
    x, y = (maths.attribute(name, "FLOAT_VECTOR") for name in _COLUMNS[:2])
    points = maths.where(blurs, _with_changes(maths, points, x, y, changes), points)
    z = vector(maths, "CROSS_PRODUCT", x, y)
    return _filed(maths, points, (_COLUMNS[2], *_COLUMNS[:2]), [_placed(maths, each) for each in (z, x, y)])


def _filed(maths, points, names, values):
    for name, value in zip(names, values):
        points = maths.store(points, name, value, "FLOAT_VECTOR")
    return points


def _with_changes(maths, points, x, y, changes):
    """The points of bones with how fast all changes. @param x, y of somebody's own frame, as `changes` of x, y and the
    place are"""
    points = _filed(maths, points, _CHANGES, changes[:2])
    x_changes, y_changes = (maths.attribute(name, "FLOAT_VECTOR") for name in _CHANGES[:2])
    z_changes = vector(maths, "ADD", vector(maths, "CROSS_PRODUCT", x_changes, y),
                       vector(maths, "CROSS_PRODUCT", x, y_changes))
    cosine, sine, _ = maths.components(_TURN)
    goes = scaled(maths, combined(maths, cosine, sine, maths.components(GROUND)[0]), maths.components(_RATES)[2])
    return _filed(maths, points, (_CHANGES[2], *_CHANGES[:2], _CHANGES[3]),
                  [*(_placed(maths, each) for each in (z_changes, x_changes, y_changes)),
                   vector(maths, "ADD", _placed(maths, changes[2]), goes)])


def _meshes(maths, people, figures, which, kept):
    """Everybody's mesh at rest, as one mesh. @param which of the figures, by point; @param kept of what points say"""
    spare = {WHO, _WALKS, _BEFORE, _STANDS, _RATES, _TURN} - set(kept)
    people = _without(maths, people, *sorted(spare))
    origin = maths.node("GeometryNodeSetPosition")
    maths.link(people, origin.inputs["Geometry"])
    origin.inputs["Position"].default_value = (0.0, 0.0, 0.0)
    maths.link(combined(maths, 0.0, 0.0, 0.0), origin.inputs["Position"])
    shapes = maths.node("GeometryNodeJoinGeometry")
    for figure in reversed(figures):  # what is linked to a Join Geometry last comes out first
        info = maths.node("GeometryNodeObjectInfo", transform_space="ORIGINAL")
        info.inputs["Object"].default_value = figure
        info.inputs["As Instance"].default_value = True
        maths.link(socket(info.outputs, "Geometry"), shapes.inputs[0])
    place = maths.node("GeometryNodeInstanceOnPoints")
    place.inputs["Pick Instance"].default_value = True
    maths.link(origin.outputs[0], place.inputs["Points"])
    maths.link(shapes.outputs[0], place.inputs["Instance"])
    maths.link(which, place.inputs["Instance Index"])
    whole = maths.node("GeometryNodeRealizeInstances")
    maths.link(place.outputs[0], whole.inputs[0])
    return whole.outputs[0]


def _without(maths, geometry, *names):
    for name in names:
        remove = maths.node("GeometryNodeRemoveAttribute")
        remove.inputs["Name"].default_value = name
        maths.link(geometry, remove.inputs[0])
        geometry = remove.outputs[0]
    return geometry


def _hung(maths, bones_, names, bone_count):
    """What all bones that a vertex hangs on make of its place at rest. @param names of x, y, z and of what is added"""
    place = parts(maths, maths.node("GeometryNodeInputPosition").outputs[0])
    separate = maths.node("FunctionNodeSeparateColor")
    maths.link(maths.attribute(bones.HANGS, "FLOAT_COLOR"), separate.inputs[0])
    hangs = separate.outputs
    first = maths.math("MULTIPLY", maths.attribute(_RANK, "INT"), float(bone_count))
    shares = [maths.math("FRACT", each) for each in hangs[1:bones.MOST]]
    left = maths.math("SUBTRACT", 1.0, maths.math("ADD", shares[0], maths.math("ADD", shares[1], shares[2])))
    total = None
    for hang, share in zip(hangs, (left, *shares)):
        index = maths.math("ADD", first, maths.math("FLOOR", hang))
        part = None
        for name, along in zip((names[3], *names[:3]), (None, *place)):
            value = (maths.attribute(name, "FLOAT_VECTOR") if name
                     else maths.node("GeometryNodeInputPosition").outputs[0])
            column = bones.sample(maths, bones_, value, index)
            part = column if part is None else vector(maths, "MULTIPLY_ADD", column, along, part)
        total = (scaled(maths, part, share) if total is None else vector(maths, "MULTIPLY_ADD", part, share, total))
    return total


def _rest_of(cast, figure):
    """An object that shows a figure's mesh at rest."""
    name = f"{figure.name} at rest"
    found = bpy.data.objects.get(name) or bpy.data.objects.new(name, figure.data)
    found.data, found[_REST] = figure.data, True
    if found.name not in cast.objects:
        cast.objects.link(found)
    return found


def _levels(cast, figures):
    """The figures of level 0, and those that show near people on the screen from COARSER_FROM on."""
    there = library.figures_of(cast)
    return [figures, *([there.get((level, member), figure) for member, figure in enumerate(figures)]
                       for level in range(1, len(COARSER_FROM) + 1))]


def _bent(maths, people, points, blurs, joints, figures, streams):
    """The points of bones, as the streams say how feet, trunks and heads go. @param joints geometry: everybody's, at
    rest"""
    sheets = [sheet_of(figure) for figure in figures]
    limbs, trunk = (bones.told_of(sheets, what) for what in (bones.LIMBS, bones.TRUNK))
    turns, count = "carriage" in streams and trunk is not None, sheets[0]["throng_bones"]
    for is_told, bend in ((FEET[0] in streams, legs.with_feet_held), (turns, trunks.with_trunks_turned),
                          (turns or heads.is_told(streams), heads.turning(streams, turns))):
        if limbs and is_told:
            points = maths.grouped(
                "Throng near limbs", [people, points, joints], lambda inner, who, bent, rest, flag, bend=bend: bend(
                    inner, who, BentBones(bent, _COLUMNS, _CHANGES, flag, rest, count, limbs, trunk), _placed),
                flag=blurs)
    return points


def _close_ones(maths, people, final, most):
    """1 for those who are close enough for meshes of more detail, in final pictures; at most so many."""
    far = maths.math("SUBTRACT", 2.0, maths.attribute(NEAR))  # 1 where they begin, 0 at the camera
    few = maths.math("LESS_THAN", far, maths.math("MINIMUM", fitting(maths, people, far, float(most)), 0.9999))
    return maths.math("MULTIPLY", few, final)


def near_tree(cast, repertoire, sheet, streams, most_close):
    """A group that makes one mesh of all points that it gets.

    @param sheet the object of all members' bones (bones.join_sheets); @param streams that points have; @param
    most_close how many at most have meshes of more detail
    """
    figures = boned_members(cast)
    tree, inputs, outputs = new_tree("Throng near people", _GEOMETRY + [("Blur", "NodeSocketBool")], _GEOMETRY)
    maths, blurs = Maths(tree), inputs.outputs["Blur"]
    joints = next(thing for thing in cast.objects if _JOINTS in thing)
    bones_, joints = (maths.geometry_of(thing) for thing in (sheet, joints))
    bone_count, pose_count = sheet_of(figures[0])["throng_bones"], repertoire.poses(0)
    people = maths.grouped("Throng near poses", [inputs.outputs[0]], lambda inner, points: _people(
        inner, points, repertoire, cast, "carriage" in streams))
    hung_on = maths.grouped("Throng near bones", [people, bones_], lambda inner, points, all_, flag: _bone_points(
        inner, points, all_, flag, pose_count, bone_count), flag=blurs)
    hung_on = _bent(maths, people, hung_on, blurs, joints, figures, streams)
    rests, *coarser = ([_rest_of(cast, figure) for figure in those] for those in _levels(cast, figures))
    shapes = sum(coarser, rests)
    coarse = maths.math("MINIMUM", maths.attribute(COARSE), float(len(COARSER_FROM)))
    detail = maths.math("MULTIPLY", coarse, maths.math("SUBTRACT", 1.0, blurs))
    finer = close.meshes_of(cast) if most_close else {}
    if finer:
        shapes += [finer.get(member, rest) for member, rest in enumerate(rests)]
        detail = maths.math("MULTIPLY_ADD", _close_ones(maths, people, blurs, most_close), 1.0 + len(coarser), detail)
    bodies = maths.store(people, _DETAIL, detail)
    if finer:
        bodies = maths.grouped("Throng near faces told", [bodies], lambda inner, points: faces.told(
            inner, points, repertoire.clips, streams))
    bodies = _without(maths, bodies, "id", "throng_dir", "throng_state", NATURE, NEAR, COARSE, GROUND, LEVEL, FIRST,
                      OWN, *(f"throng_{stream}" for stream in streams))
    which = maths.math("MULTIPLY_ADD", maths.attribute(_DETAIL), float(len(figures)), maths.attribute(WHO, "INT"))
    mesh = _meshes(maths, bodies, shapes, which, (WHO,))
    if finer:
        mesh = maths.where(blurs, maths.grouped("Throng near faces", [mesh], faces.moved), mesh)
    velocity, place = (maths.grouped("Throng near skin", [hung_on], lambda inner, bent, names=names: _hung(
        inner, bent, names, bone_count), "NodeSocketVector") for names in (_CHANGES, (*_COLUMNS, "")))
    mesh = maths.where(blurs, maths.store(mesh, "velocity", velocity, "FLOAT_VECTOR"), mesh)
    put = maths.node("GeometryNodeSetPosition")
    maths.link(mesh, put.inputs["Geometry"])
    maths.link(place, put.inputs["Position"])
    mesh = _without(maths, put.outputs[0], WHO, _RANK, _DETAIL, bones.HANGS, *(faces.SPARE if finer else ()))
    maths.link(mesh, outputs.inputs[0])
    return tree
