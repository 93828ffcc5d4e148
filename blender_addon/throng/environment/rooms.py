# SPDX-License-Identifier: Apache-2.0
"""Rooms behind windows, by ray arithmetic in the shader: where a sight goes through a pane, it is followed to the
walls, floor, ceiling and furniture of a room that has no geometry. Panes say by the UV map `rooms`, in metres, where in
which room they are: each room is as wide and as high as its form, side by side from u = 0, and on each other from
v = 0."""
from typing import NamedTuple

import bpy

from ..blender.nodes import new_tree, own_tree
from . import materials
from .shading import Shading, not_a_lamp
from .shapes import UV_ROOMS

ROOMS = "Throng rooms"


class Form(NamedTuple):
    """Of rooms: sizes in metres, and shares of all rooms."""
    width: float
    height: float
    depth: float
    pane: float      # width of the window, which curtains hang beside
    head: float      # where the window ends above: blinds come down from there
    lit: float       # times the share that is lit at this time of the day
    curtains: float
    blinds: float
    shelves: float   # 0 pictures on the wall, 1 goods and books
    strips: float    # 0 a lamp, 1 strips of light on the ceiling


FORMS = {"flat": Form(2.7, 3.5, 4.2, 1.3, 2.70, 1.0, 0.62, 0.22, 0.0, 0.0),
         "office": Form(5.4, 3.5, 6.5, 5.4, 3.05, 1.25, 0.0, 0.38, 0.25, 1.0),
         "shop": Form(5.4, 4.3, 5.5, 5.4, 3.40, 9.0, 0.0, 0.0, 0.75, 1.0)}
_GIVEN = ("Width", "Height", "Depth", "Pane", "Head", "Lit", "Curtains", "Blinds", "Shelves", "Strips")


def pane(kind):
    """Glass with rooms of one of FORMS behind it."""
    found = bpy.data.materials.get(f"throng rooms {kind}")
    if found:
        return found
    material = materials.glass().copy()
    material.name = f"throng rooms {kind}"
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (0.004, 0.005, 0.006, 1.0)
    shader.inputs["Roughness"].default_value = 0.02
    group = nodes.new("ShaderNodeGroup")
    group.node_tree = _rooms()
    for name, value in zip(_GIVEN, FORMS[kind]):
        group.inputs[name].default_value = value
    links.new(group.outputs["Colour"], shader.inputs[materials.emission_of(shader)])
    links.new(group.outputs["Normal"], shader.inputs["Normal"])
    for link in [*shader.inputs["Emission Strength"].links]:
        links.remove(link)
    shader.inputs["Emission Strength"].default_value = 1.0
    not_a_lamp(material)
    return material


def light_rooms(daylight, lamps, lit):
    """How bright rooms are: from outside, by their lamps, and the share of flats that have lamps on."""
    nodes = _rooms().nodes
    for name, value in (("Daylight", daylight), ("Lamps", lamps), ("Lit", lit)):
        nodes[name].outputs[0].default_value = value


class _Sight(NamedTuple):
    """A sight into a room, x along the facade, y inwards, z up, from the room's corner."""
    start: object
    way: object
    x: object        # the parts of `start` and `way` that are used alone
    z: object
    inwards: object


def _rooms():
    tree = own_tree(ROOMS)
    if tree:
        return tree
    tree, given, result = new_tree(ROOMS, [(name, "NodeSocketFloat") for name in _GIVEN],
                                   [("Colour", "NodeSocketColor"), ("Normal", "NodeSocketVector")], "ShaderNodeTree")
    shading, form = Shading(tree), given.outputs
    for name, value in (("Daylight", 0.1), ("Lamps", 0.1), ("Lit", 0.1)):
        shading.node("ShaderNodeValue", name=name).outputs[0].default_value = value
    number, sight, normal = _sight(shading, form)
    chance = [*_chances(shading, number, 0.0), *_chances(shading, number, 0.37), *_chances(shading, number, 0.71)]
    lit = shading.math("LESS_THAN", chance[0], shading.math("MULTIPLY", tree.nodes["Lit"].outputs[0], form["Lit"]))
    lamps = shading.math("MULTIPLY", shading.math("MULTIPLY", lit, tree.nodes["Lamps"].outputs[0]),
                         shading.math("MULTIPLY_ADD", chance[1], 0.8, 0.6))
    inside = _inside(shading, form, sight, chance, lamps)
    shading.link(_hangings(shading, form, sight, chance, lamps, inside), result.inputs["Colour"])
    # old panes do not all lie in one plane: what they mirror breaks from pane to pane
    tilt = shading.times(shading.vector("SUBTRACT", shading.combine(*chance[6:9]), (0.5, 0.5, 0.5)), 0.022)
    waves = shading.node("ShaderNodeTexNoise")
    waves.inputs["Scale"].default_value, waves.inputs["Detail"].default_value = 0.9, 0.0
    shading.link(shading.node("ShaderNodeTexCoord").outputs["Object"], waves.inputs["Vector"])
    bent = shading.times(shading.vector("SUBTRACT", waves.outputs["Color"], (0.5, 0.5, 0.5)), 0.016)
    shading.link(shading.vector("NORMALIZE", shading.vector("ADD", normal, shading.vector("ADD", tilt, bent))),
                 result.inputs["Normal"])
    return tree


def _chances(shading, number, shift):
    """Three numbers at random for a room."""
    node = shading.node("ShaderNodeTexWhiteNoise")
    shading.link(shading.vector("ADD", number, (shift, 3.0 * shift, shift)), node.inputs["Vector"])
    return shading.separate(node.outputs["Color"])


def _sight(shading, form):
    """(the room's number as a vector, the sight into it, the pane's normal)"""
    u, v, _ = shading.separate(shading.node("ShaderNodeUVMap", uv_map=UV_ROOMS).outputs[0])
    column = shading.math("FLOOR", shading.math("DIVIDE", u, form["Width"]))
    row = shading.math("FLOOR", shading.math("DIVIDE", v, form["Height"]))
    x = shading.math("SUBTRACT", u, shading.math("MULTIPLY", column, form["Width"]))
    z = shading.math("SUBTRACT", v, shading.math("MULTIPLY", row, form["Height"]))
    which = shading.math("MULTIPLY", shading.node("ShaderNodeObjectInfo").outputs["Random"], 97.0)
    geometry = shading.node("ShaderNodeNewGeometry")
    normal = geometry.outputs["True Normal"]
    sight = shading.times(geometry.outputs["Incoming"], -1.0)
    along = shading.vector("CROSS_PRODUCT", (0.0, 0.0, 1.0), normal)
    inwards = shading.math("MAXIMUM", shading.math("MULTIPLY", shading.vector("DOT_PRODUCT", sight, normal), -1.0),
                           0.01)
    # never quite along an axis: what follows divides by all three
    way = shading.combine(shading.math("ADD", shading.vector("DOT_PRODUCT", sight, along), 1.3e-5), inwards,
                          shading.math("ADD", shading.separate(sight)[2], 1.7e-5))
    return shading.combine(column, row, which), _Sight(shading.combine(x, 0.0, z), way, x, z, inwards), normal


def _slabs(shading, sight, low, high):
    """How far it is to the nearer and to the farther plane of each axis of a box, as vectors."""
    ways = [shading.vector("DIVIDE", shading.vector("SUBTRACT", corner, sight.start), sight.way)
            for corner in (low, high)]
    return shading.vector("MINIMUM", *ways), shading.vector("MAXIMUM", *ways)


def _place(shading, sight, away):
    return shading.vector("ADD", sight.start, shading.times(sight.way, away))


def _extreme(shading, operation, numbers):
    return shading.math(operation, shading.math(operation, numbers[0], numbers[1]), numbers[2])


def _inside(shading, form, sight, chance, lamps):
    """The colour of what stands at the sight's end."""
    corner = shading.combine(form["Width"], form["Depth"], form["Height"])
    ends = shading.separate(_slabs(shading, sight, (0.0, 0.0, 0.0), corner)[1])
    away = _extreme(shading, "MINIMUM", ends)
    level = shading.math("LESS_THAN", ends[2], shading.math("ADD", away, 1e-4))
    upwards = shading.math("GREATER_THAN", shading.separate(sight.way)[2], 0.0)
    ceiling = shading.math("MULTIPLY", level, upwards)
    place = _place(shading, sight, away)
    colour = _walls(shading, form, place, chance)
    floor = shading.mix(chance[2], (0.16, 0.085, 0.045), (0.20, 0.19, 0.175))
    colour = shading.mix(level, colour, shading.mix(upwards, floor, (0.66, 0.65, 0.62)))
    for box in _furniture(shading, form, chance):
        colour, away = _with_box(shading, sight, box, colour, away)
    place = _place(shading, sight, away)
    x, y, z = shading.separate(place)
    # daylight falls off behind the pane, and more of it falls on what is low
    deep = shading.math("MULTIPLY_ADD", shading.math("MULTIPLY", y, y), 0.22, 1.0)
    day = shading.math("DIVIDE", shading.tree.nodes["Daylight"].outputs[0], deep)
    day = shading.math("MULTIPLY", day, shading.math("MULTIPLY_ADD", shading.math("DIVIDE", z, form["Height"]), -0.35,
                                                     1.15))
    hung = shading.combine(shading.math("MULTIPLY", form["Width"], 0.5), shading.math("MULTIPLY", form["Depth"], 0.5),
                           shading.math("SUBTRACT", form["Height"], 0.8))
    far = shading.vector("LENGTH", shading.vector("SUBTRACT", place, hung))
    pool = shading.math("DIVIDE", 2.6, shading.math("MULTIPLY_ADD", shading.math("MULTIPLY", far, far), 0.55, 0.6))
    even = shading.between(form["Strips"], pool, 0.95)
    warm = shading.mix(form["Strips"], (1.0, 0.60, 0.28), (1.0, 0.86, 0.66))
    light = shading.add_colours(shading.times((0.86, 0.95, 1.05), day),
                                shading.times(warm, shading.math("MULTIPLY", lamps, even)))
    seen = shading.vector("MULTIPLY", colour, light)
    return shading.add_colours(seen, shading.times(warm, _lamp(shading, form, (x, y), ceiling, lamps)))


def _lamp(shading, form, place, ceiling, lamps):
    """How bright the strips of light on a ceiling are."""
    x, y = place
    across = shading.math("LESS_THAN", shading.math("PINGPONG", shading.math("ADD", y, 0.4), 0.9), 0.13)
    ends = shading.math("GREATER_THAN", shading.math("PINGPONG", x, 0.9), 0.16)
    strip = shading.math("MULTIPLY", shading.math("MULTIPLY", across, ends), shading.math("MULTIPLY", ceiling, lamps))
    return shading.math("MULTIPLY", strip, shading.math("MULTIPLY", form["Strips"], 7.0))


def _walls(shading, form, place, chance):
    """Painted walls, with a picture each, or shelves full of goods."""
    x, y, z = shading.separate(place)
    paint = shading.mix(chance[3], (0.56, 0.50, 0.41), (0.46, 0.50, 0.50))
    paint = shading.mix(shading.math("MULTIPLY", chance[4], 0.5), paint, (0.42, 0.24, 0.16))
    along = shading.math("ADD", x, shading.math("MULTIPLY", y, 1.37))  # on whichever wall
    middle = shading.math("MULTIPLY_ADD", chance[5], 0.9, 0.9)
    framed = shading.math("MULTIPLY", shading.math("COMPARE", shading.math("MODULO", along, 3.1), middle, 0.42),
                          shading.math("COMPARE", z, 1.75, 0.36))
    drawn = shading.mix(shading.noise(shading.times(place, 3.0), 1.0, 2.0), (0.04, 0.07, 0.12), (0.62, 0.42, 0.20))
    pictures = shading.mix(framed, paint, drawn)
    shelf = shading.math("MULTIPLY", shading.math("LESS_THAN", chance[7], form["Shelves"]),
                         shading.math("LESS_THAN", z, shading.math("MULTIPLY_ADD", chance[2], 0.9, 1.5)))
    return shading.mix(shelf, pictures, _goods(shading, along, z, chance))


def _goods(shading, along, z, chance):
    """Shelves with boxes of one shop's sizes and colours, and gaps."""
    across = shading.math("MULTIPLY", along, shading.math("MULTIPLY_ADD", chance[8], 9.0, 2.5))
    up = shading.math("MULTIPLY", z, shading.math("MULTIPLY_ADD", chance[1], 1.4, 1.7))
    cell = shading.combine(shading.math("FLOOR", across), shading.math("FLOOR", up), chance[6])
    node = shading.node("ShaderNodeTexWhiteNoise")
    shading.link(cell, node.inputs["Vector"])
    one, other, kind = shading.separate(node.outputs["Color"])
    house = shading.mix(chance[3], (0.34, 0.09, 0.06), (0.07, 0.17, 0.24))
    goods = shading.mix(shading.math("MULTIPLY", other, 0.7), shading.mix(one, (0.06, 0.05, 0.045), (0.44, 0.39, 0.32)),
                        house)
    # goods do not reach up to the next board, each to a height of its own
    filled = shading.math("LESS_THAN", shading.math("FRACT", up), shading.math("MULTIPLY_ADD", kind, 0.8, 0.22))
    goods = shading.mix(filled, (0.035, 0.030, 0.027), goods)
    return shading.mix(shading.math("LESS_THAN", shading.math("FRACT", up), 0.10), goods, (0.26, 0.19, 0.13))


def _furniture(shading, form, chance):
    """(low corner, high corner, colour) of a table, a cupboard at the back, and something on the table."""
    def number(share, scale, least):
        return shading.math("MULTIPLY_ADD", share, scale, least)

    left = shading.math("MULTIPLY", form["Width"], number(chance[8], 0.38, 0.08))
    right = shading.math("ADD", left, number(chance[4], 0.7, 0.9))
    front = number(chance[5], 0.7, 0.55)
    back, high = shading.math("ADD", front, 0.75), number(chance[7], 0.35, 0.55)
    cloth = shading.mix(chance[3], (0.28, 0.17, 0.09), (0.20, 0.22, 0.26))
    tall_left = shading.math("MULTIPLY", form["Width"], number(chance[1], 0.5, 0.05))
    thing_left = shading.math("ADD", left, 0.25)
    return [(shading.combine(left, front, 0.0), shading.combine(right, back, high), cloth),
            (shading.combine(tall_left, shading.math("SUBTRACT", form["Depth"], 0.55), 0.0),
             shading.combine(shading.math("ADD", tall_left, number(chance[6], 0.6, 0.7)), form["Depth"],
                             number(chance[2], 0.9, 1.2)),
             shading.mix(chance[5], (0.30, 0.20, 0.12), (0.5, 0.5, 0.48))),
            (shading.combine(thing_left, shading.math("ADD", front, 0.25), high),
             shading.combine(shading.math("ADD", thing_left, 0.32), shading.math("ADD", front, 0.5),
                             shading.math("ADD", high, number(chance[0], 0.35, 0.2))),
             shading.mix(chance[8], (0.42, 0.10, 0.06), (0.08, 0.20, 0.22)))]


def _with_box(shading, sight, box, colour, away):
    """(colour, distance) with a box in the room."""
    near, far = _slabs(shading, sight, *box[:2])
    near = shading.separate(near)
    enters, leaves = _extreme(shading, "MAXIMUM", near), _extreme(shading, "MINIMUM", shading.separate(far))
    met = shading.math("MULTIPLY", shading.math("LESS_THAN", enters, leaves),
                       shading.math("MULTIPLY", shading.math("LESS_THAN", enters, away),
                                    shading.math("GREATER_THAN", enters, 0.0)))
    top = shading.math("GREATER_THAN", near[2], shading.math("SUBTRACT", enters, 1e-4))
    side = shading.math("GREATER_THAN", near[0], shading.math("SUBTRACT", enters, 1e-4))
    shade = shading.math("SUBTRACT", shading.math("MULTIPLY_ADD", top, 0.7, 0.9), shading.math("MULTIPLY", side, 0.35))
    return shading.mix(met, colour, shading.times(box[2], shade)), shading.between(met, away, enters)


def _hangings(shading, form, sight, chance, lamps, inside):
    """Curtains and blinds a hand behind the pane."""
    hung = shading.separate(_place(shading, sight, shading.math("DIVIDE", 0.10, sight.inwards)))
    day = shading.math("MULTIPLY", shading.tree.nodes["Daylight"].outputs[0], 1.5)
    light = shading.add_colours(shading.times((0.95, 1.0, 1.05), day),
                                shading.times((1.0, 0.66, 0.36), shading.math("MULTIPLY", lamps, 0.75)))
    from_middle = shading.math("ABSOLUTE", shading.math("SUBTRACT", hung[0],
                                                        shading.math("MULTIPLY", form["Width"], 0.5)))
    opened = shading.math("MULTIPLY", shading.math("MULTIPLY", form["Pane"], 0.5),
                          shading.math("MULTIPLY_ADD", chance[4], 0.75, 0.15))
    drawn = shading.math("MULTIPLY", shading.math("GREATER_THAN", from_middle, opened),
                         shading.math("LESS_THAN", chance[7], form["Curtains"]))
    folds = shading.math("MULTIPLY_ADD", shading.math("SINE", shading.math("MULTIPLY", hung[0], 68.0)), 0.20, 0.72)
    cloth = shading.mix(chance[8], (0.72, 0.68, 0.58), shading.mix(chance[2], (0.45, 0.20, 0.13), (0.20, 0.30, 0.33)))
    colour = shading.mix(shading.math("MULTIPLY", drawn, 0.93), inside,
                         shading.vector("MULTIPLY", shading.times(cloth, folds), light))
    end = shading.math("SUBTRACT", form["Head"], shading.math("MULTIPLY_ADD", chance[5], 1.5, 0.15))
    down = shading.math("MULTIPLY", shading.math("GREATER_THAN", hung[2], end),
                        shading.math("GREATER_THAN", chance[7], shading.math("SUBTRACT", 1.0, form["Blinds"])))
    slats = shading.math("MULTIPLY_ADD", shading.math("FRACT", shading.math("MULTIPLY", hung[2], 18.0)), 0.30, 0.50)
    return shading.mix(shading.math("MULTIPLY", down, 0.94), colour, shading.times(light, slats))
