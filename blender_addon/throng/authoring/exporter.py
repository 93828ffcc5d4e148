# SPDX-License-Identifier: Apache-2.0
"""A scene as a layout. What came from a layout and was not changed since is written as it was, to the last digit."""
import json
import math
import os

import bpy

from ..formats.whole_files import write_whole
from . import behaviours, fields, given, levels, places, seats
from .codecs import take_all
from .geometry import AuthoringError, outlines_of, people_of, splines_of, top_of
from .values import MISSING, are_points, is_number, is_point, keep_points, short, world_point

LISTS = {"LEVEL": "levels", "LINK": "links", "ROAD": "roads", "AREA": "areas", "WALL": "walls", "PATCH": "patches",
         "SEATS": "seats", "FORMATION": "formations"}
LISTED = ("levels", "links", "roads", "areas", "walls", "patches", "behaviours", "flows", "formations", "events",
          "given", "seats", "shows")


def origin_of(scene):
    return tuple(json.loads(scene.throng_layout.origin or "[0, 0]"))


def parts_of(scene, kind):
    """A scene's objects of a kind, in the layout's order; new ones come last, by name."""
    return sorted((thing for thing in scene.objects if thing.throng_layout.kind == kind),
                  key=lambda thing: (thing.throng_layout.order, thing.name))


def id_of(thing):
    """An object's name, or what the layout called it as long as it keeps the name that it was given for that. None:
    the layout gave none."""
    part = thing.throng_layout
    if part.raw and thing.name == part.imported_name:
        return json.loads(part.raw).get("id")
    return thing.name


class ExportWorld:
    """Names and coordinates of objects."""

    def __init__(self, scene):
        self.origin = origin_of(scene)
        self.tolerance = scene.throng_layout.tolerance
        source = bpy.path.abspath(scene.throng_layout.source)
        self.folder = os.path.dirname(source) if source else None
        self._names = {}
        # In the layout's order, and by what that calls them.
        self._levels = parts_of(scene, "LEVEL")
        self._levels_by_id = {_raw(thing).get("id"): thing for thing in reversed(self._levels)
                              if thing.throng_layout.raw}
        # Those of places in the layout that was imported, and what they are called now.
        # Copies have what they were copied from in mind, and do not count.
        places = [thing for thing in scene.objects
                  if thing.throng_layout.kind in ("ROAD", "AREA") and thing.throng_layout.raw]
        places.sort(key=lambda thing: thing.name == thing.throng_layout.imported_name)
        self._places = {_raw(thing).get("id"): thing for thing in places}

    def place_named(self, text):
        """A place by its name in the layout that was imported."""
        name, _, end = text.rpartition(":")
        for known, ending in ((text, ""), (name, f":{end}")):
            if known in self._places:
                return self.name(self._places[known]) + ending
        return text

    def has_level(self, thing):
        """Whether that is a level, and has not been deleted."""
        return thing is not None and thing in self._levels

    def first_level(self):
        return self._levels[0] if self._levels else None

    def is_level(self, text):
        return text in self._levels_by_id

    def level_named(self, text):
        """A level by its name in the layout that was imported."""
        return self.name(self._levels_by_id[text]) if text in self._levels_by_id else text

    def destination_named(self, raw):
        """A place, the nearest of several or a choice, likewise."""
        if isinstance(raw, str):
            return self.place_named(raw)
        named = {"nearest": lambda places: [self.place_named(each) for each in places],
                 "choose": lambda shares: {self.place_named(each): share for each, share in shares.items()}}
        return {key: named[key](value) if key in named and isinstance(value, (list, dict)) else value
                for key, value in raw.items()}

    def name(self, thing):
        if thing not in self._names:
            name = id_of(thing)
            self._names[thing] = thing.name if name is None else name
        return self._names[thing]

    def file(self, path):
        """One that the layout names, chosen in Blender."""
        return given.from_folder(bpy.path.abspath(path) if path.startswith("//") else path, self.folder)

    def place(self, thing, end):
        return f"{self.name(thing)}:{end}" if thing.throng_layout.kind == "ROAD" else self.name(thing)

    def point_of(self, thing, raw=None):
        point = thing.matrix_world.translation[:2]
        return keep_points([point], [raw], self.origin)[0] if is_point(raw) else world_point(point, self.origin)

    def line_of(self, thing, raw=None):
        return self.kept(splines_of(thing, self.tolerance)[0][0], raw)

    def kept(self, points, raw):
        return keep_points(points, raw if are_points(raw, 1) else [], self.origin)


def _raw(thing):
    part = thing.throng_layout
    return json.loads(part.raw) if part.raw else {}


def _named(thing, raw):
    name = id_of(thing)
    return {**({} if name is None else {"id": name}), **{key: value for key, value in raw.items() if key != "id"}}


def _road(thing, world):
    raw = _raw(thing)
    if thing.type != "CURVE":
        raise AuthoringError(f"{thing.name} is a {thing.type.lower()}: a road is a curve", thing)
    splines = splines_of(thing, world.tolerance)
    if len(splines) > 1 or splines[0][1]:
        raise AuthoringError(f"{thing.name}: a road is one open curve; separate its splines, or mark it as an area",
                             thing)
    result = take_all(fields.ROAD, thing.throng_layout, _named(thing, raw))
    result["centreline"] = world.kept(splines[0][0], raw.get("centreline"))
    return [result]


def _outline(thing, world, what, raw):
    """The only one that a curve or a mesh has."""
    if thing.type == "CURVE":
        outlines = [points for points, _ in splines_of(thing, world.tolerance)]
    else:
        outlines = _mesh(thing)[0]
    if len(outlines) != 1:
        raise AuthoringError(f"{thing.name} has {len(outlines)} outlines: {what} is one polygon; separate its parts",
                             thing)
    return world.kept(outlines[0], raw.get("polygon"))


def _level(thing, world):
    raw = _raw(thing)
    result = _named(thing, raw)
    place = levels.place_in_ground(raw)
    if thing.type == "EMPTY":
        now = tuple(thing.matrix_world.translation)
        if place and max(abs(a + o - b) for a, o, b in zip(now, (*world.origin, 0.0), place)) > 1e-3:
            result["at"] = [*world_point(now[:2], world.origin), short(now[2])]
        return [result]
    result["floor"] = _outline(thing, world, "a level's floor", {"polygon": raw.get("floor")})
    height = levels.written_height(top_of(thing), raw)
    if height is not MISSING:
        result["height"] = height
    return [result]


def _link(thing, world):
    raw = _raw(thing)
    if thing.type == "EMPTY":
        result = levels.take_lift(_named(thing, raw), world)
        result["at"] = world.point_of(thing, raw.get("at"))
        return [result]
    if thing.type != "CURVE":
        raise AuthoringError(f"{thing.name} is a {thing.type.lower()}: a link is a curve", thing)
    splines = splines_of(thing, world.tolerance)
    if len(splines) > 1 or splines[0][1]:
        raise AuthoringError(f"{thing.name}: a link is one open curve; separate its splines", thing)
    result = levels.take_link(thing.throng_layout.link, _named(thing, raw), world)
    result["path"] = world.kept(splines[0][0], raw.get("path"))
    return [result]


def _area(thing, world):
    raw = _raw(thing)
    return [{**_named(thing, raw), "polygon": _outline(thing, world, "an area", raw)}]


def _patch(thing, world):
    raw = _raw(thing)
    result = take_all(fields.PATCH, thing.throng_layout.patch, _named(thing, raw))
    result["polygon"] = _outline(thing, world, "a patch", raw)
    return [result]


def _mesh(thing):
    if thing.type != "MESH":
        raise AuthoringError(f"{thing.name} is a {thing.type.lower()}: areas and walls are curves or meshes", thing)
    return outlines_of(thing)


def _walls(thing, world):
    """A wall for each spline or footprint; further ones get numbers to their name."""
    raw, part = _raw(thing), thing.throng_layout
    if thing.type == "CURVE":
        shapes, height = splines_of(thing, world.tolerance), None
    else:
        outlines, height = _mesh(thing)
        shapes = [(outline, True) for outline in outlines]
    result = []
    for number, (points, closed) in enumerate(shapes):
        wall = take_all(fields.CLOSED_WALL if closed else fields.OPEN_WALL, part, _named(thing, raw))
        if height:
            wall["height"] = short(height)
        if closed != bool(raw.get("closed", False)):
            wall["closed"] = closed
        wall["points"] = world.kept(points, raw.get("points") if number == 0 else None)
        if number > 0:
            wall["id"] = f"{wall.get('id', thing.name)}.{number + 1}"
        result.append(wall)
    return result


def _turn(thing, raw):
    """The rotation about z in degrees: the layout's own as long as it says the same."""
    degrees = thing.matrix_world.to_euler().z * 57.29577951308232
    old = raw if is_number(raw) else 0.0
    difference = (degrees - old + 180.0) % 360.0 - 180.0
    return raw if abs(difference) < 1e-3 else short(degrees)


def _scaled(result, thing, keys):
    """Scaling an object scales what it shows."""
    scale = abs(thing.matrix_world.to_scale().x)
    if abs(scale - 1.0) > 1e-5:
        result.update({key: short(scale * result[key]) for key in keys if is_number(result.get(key))})


def _formation(thing, world):
    part, raw = thing.throng_layout.formation, _raw(thing)
    old = raw if raw.get("type") == part.type else {key: raw[key] for key in ("id",) if key in raw}
    codecs = (*fields.FORMATION[part.type], places.BEHAVIOUR)
    result = take_all(codecs, part, {**_named(thing, old), "type": part.type}, world)
    if part.type == "circle":
        result["centre"] = world.point_of(thing, old.get("centre"))
        _scaled(result, thing, ("radius", "ring_spacing", "along"))
    elif part.type == "grid":
        result["origin"] = world.point_of(thing, old.get("origin"))
        values = {"rotation": _turn(thing, old.get("rotation", MISSING)),
                  "goal": places.take_goal(part, old.get("goal", MISSING), world)}
        result.update({key: value for key, value in values.items() if value is not MISSING})
        scale = thing.matrix_world.to_scale().x
        if abs(scale - 1.0) > 1e-5:
            result["spacing"] = short(scale * part.spacing)
    else:
        result["agents"] = _agents(thing, old.get("agents"), world)
        if "behaviour" in result:
            result["agents"] = [{key: value for key, value in each.items() if key not in ("goal", "via", "wait")}
                                for each in result["agents"]]
    return [places.without_goal(places.in_place_of(result, raw, ("goal", "arrival", "wait")), "goal")]


def _seats(thing, world):
    part, raw = thing.throng_layout.seats, _raw(thing)
    is_arc = part.shape == "ARC"
    foreign = "front" if is_arc else "arc"
    result = {key: value for key, value in _named(thing, raw).items() if key != foreign}
    if is_arc:
        result["arc"] = _arc(thing, part, raw.get("arc"), world)
    else:
        result["front"] = world.kept(first_row(thing, world.tolerance), raw.get("front"))
    return [take_all(seats.SEATS, part, result, world)]


def first_row(thing, tolerance):
    """The points of the curve that it is, in the world."""
    if thing.type != "CURVE":
        raise AuthoringError(f"{thing.name} is a {thing.type.lower()}: seats are a curve, their first row", thing)
    splines = splines_of(thing, tolerance)
    if len(splines) > 1 or splines[0][1]:
        raise AuthoringError(f"{thing.name}: the first row of seats is one open curve; separate its splines, or make "
                             "it an arc", thing)
    return splines[0][0]


def _arc(thing, part, raw, world):
    """Moving, turning, scaling and mirroring the object counts."""
    raw = raw if isinstance(raw, dict) else {}
    result = {"centre": world.point_of(thing, raw.get("centre")),
              **take_all(fields.ARC, part, {key: value for key, value in raw.items() if key != "centre"})}
    _scaled(result, thing, ("radius",))
    (a, b), (c, d) = (row[:2] for row in thing.matrix_world[:2])
    turn, ends = math.degrees(math.atan2(c, a)), (result["from"], result["to"])
    if not all(is_number(end) for end in ends):
        return result
    if a * d < b * c:  # mirrored
        ends = (turn - ends[1], turn - ends[0])
    elif abs(turn) > 1e-3:
        ends = (turn + ends[0], turn + ends[1])
    return {**result, **{key: result[key] if end == result[key] else short(round(end, 5))
                         for key, end in zip(("from", "to"), ends)}}


def _agents(thing, raw, world):
    raw = raw if isinstance(raw, list) else []
    people = people_of(thing)
    olds = [raw[number] if 0 <= number < len(raw) else {} for _, _, number in people]
    result = [dict(old) for old in olds]
    for end, key in enumerate(("position", "goal")):
        before = [old.get(key) for old in olds]
        known = [point if is_point(point) else [math.inf, math.inf] for point in before]
        for entry, point in zip(result, keep_points([person[end] for person in people], known, world.origin)):
            entry[key] = point
    for entry, old in zip(result, olds):
        if isinstance(old.get("goal"), (str, dict)):  # a place, that has no end of an edge
            entry["goal"] = world.destination_named(old["goal"])
    return result


_WRITERS = {"LEVEL": _level, "LINK": _link, "ROAD": _road, "AREA": _area, "WALL": _walls, "PATCH": _patch,
            "SEATS": _seats, "FORMATION": _formation}


def _entries_of(thing, kind, world):
    """What the layout has of an object, on its level."""
    entries = _WRITERS[kind](thing, world)
    level = levels.take_level(thing, _raw(thing), world) if kind in levels.ON_LEVELS else MISSING
    for entry in entries if kind in levels.ON_LEVELS else ():
        entry.update({} if level is MISSING else {"level": level})
        if level is MISSING:
            entry.pop("level", None)
    return entries


def _settings(layout, raw):
    return {codec.key: codec.take(layout, raw.get(codec.key, MISSING)) for codec in fields.SETTINGS}


def export_layout(context):
    """The scene as (layout, sources). `sources` says what each part of the layout came from: a JSON pointer ->
    (object, list, index)."""
    scene = context.scene
    context.view_layer.update()
    layout, world = scene.throng_layout, ExportWorld(scene)
    raw = json.loads(layout.raw) if layout.raw else {}
    result = {"throng": 1, **raw}
    if layout.name != (raw.get("name") if isinstance(raw.get("name"), str) else ""):
        result["name"] = layout.name
    lists, sources = {key: [] for key in LISTED}, {}
    for kind, key in LISTS.items():
        for thing in parts_of(scene, kind):
            for entry in _entries_of(thing, kind, world):
                sources[f"/{key}/{len(lists[key])}"] = (thing, "", -1)
                lists[key].append(entry)
    for key, group, take in (("behaviours", layout.behaviours, behaviours.take_behaviour),
                             ("flows", layout.flows, places.take_flow), ("events", layout.events, places.take_event),
                             ("given", layout.given, given.take_given), ("shows", layout.shows, seats.take_show)):
        for index, item in enumerate(group):
            sources[f"/{key}/{index}"] = (None, key, index)
            lists[key].append(take(item, world))
    values = {**_settings(layout, raw), "expect": places.take_expect(layout, raw.get("expect", MISSING), world)}
    values.update({key: entries for key, entries in lists.items() if entries or key in raw})
    result.update({key: value for key, value in values.items() if value is not MISSING})
    return result, sources


def layout_text(document):
    """JSON with a line for each thing, as a person would write it."""
    lines = []
    for key, value in document.items():
        if isinstance(value, list) and value:
            entries = ",\n".join("  " + json.dumps(entry, ensure_ascii=False) for entry in value)
            lines.append(f' {json.dumps(key)}: [\n{entries}\n ]')
        else:
            lines.append(f" {json.dumps(key)}: {json.dumps(value, ensure_ascii=False)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def write_text(path, text):
    """All of it or nothing."""
    try:
        write_whole(path, text.encode())
    except OSError as error:
        raise AuthoringError(f"{path} cannot be written: {error.strerror}") from None


def folder_of_files(scene, document):
    """The folder where files that a layout names are looked for; None when it names none, or came from nowhere."""
    source = bpy.path.abspath(scene.throng_layout.source)
    named = "terrain" in document or any("file" in each for each in document.get("given", ()))
    return os.path.dirname(source) if source and named else None


def default_name(scene):
    """What a bake of this scene is called."""
    name = scene.throng_layout.name or os.path.splitext(os.path.basename(bpy.data.filepath))[0] or "crowd"
    plain = "".join(character if character.isalnum() or character in "-_. " else "-" for character in name)
    return plain.strip(" .") or "crowd"
