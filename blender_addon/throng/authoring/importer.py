# SPDX-License-Identifier: Apache-2.0
"""A layout as objects, flows and settings that can be edited."""
import json
import math
import os

import bpy

from . import behaviours, codecs, display, fields, geometry, given, levels, places, seat_drawing, seats
from .exporter import LISTED, LISTS, parts_of
from .geometry import AuthoringError
from .values import MISSING, are_points, is_number, is_point

COLLECTION = "Throng Layout"
_FAR = 2048.0  # m: further out, single floats are coarser than a quarter of a millimetre
_SHAPES = {"levels": ("floor", 3), "links": ("path", 2),
           "roads": ("centreline", 2), "areas": ("polygon", 3), "walls": ("points", 2),
           "patches": ("polygon", 3)}


def read_layout(path):
    """A layout file's content, as far as importing needs it to be sound. Raises AuthoringError."""
    try:
        with open(path, encoding="utf-8") as file:
            document = json.load(file)
    except OSError as error:
        raise AuthoringError(f"{path} cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise AuthoringError(f"{path} is not JSON: {error}") from None
    if not isinstance(document, dict) or document.get("throng") != 1:
        hint = 'a layout begins with {"throng": 1}'
        if isinstance(document, dict) and "throng_family" in document:
            hint = "this is a family of layouts: `throng batch` bakes it"
        raise AuthoringError(f"{path} is no Throng layout: {hint}")
    for pointer, problem in _problems(document):
        raise AuthoringError(f"{path}: {pointer}: {problem}; `throng check` says everything that is wrong with it")
    return document


def _problems(document):
    for key in LISTED:
        entries = document.get(key, [])
        if not isinstance(entries, list):
            yield f"/{key}", "expected a list"
            return
        for i, entry in enumerate(entries):
            if not isinstance(entry, dict):
                yield f"/{key}/{i}", "expected an object"
            elif _is_empty(key, entry):
                continue
            elif key in _SHAPES and not are_points(entry.get(_SHAPES[key][0]), _SHAPES[key][1]):
                yield f"/{key}/{i}/{_SHAPES[key][0]}", f"expected at least {_SHAPES[key][1]} points [x, y]"
            elif key == "formations":
                yield from _formation_problems(entry, f"/{key}/{i}")
            elif key == "seats":
                yield from _seats_problems(entry, f"/{key}/{i}")


def _is_empty(key, entry):
    """Whether it has a place and no shape: lifts, and levels that are parts of a terrain."""
    return (key == "links" and levels.is_lift(entry) and is_point(entry.get("at"))
            or key == "levels" and levels.place_in_ground(entry) is not None)


def _is_person(entry, behaves):
    """@param behaves a behaviour stands in place of goals"""
    goes = isinstance(entry, dict) and (is_point(entry.get("goal")) or isinstance(entry.get("goal"), (str, dict))
                                        or behaves and "goal" not in entry)
    return goes and is_point(entry.get("position"))


def _way_of(person):
    """Who goes to a place is shown where it stands."""
    goal = person.get("goal")
    return [person["position"], goal if is_point(goal) else person["position"]]


def _formation_problems(entry, pointer):
    kind = entry.get("type")
    if kind not in fields.FORMATION:
        yield f"{pointer}/type", "expected circle, grid or agents"
    elif kind == "agents":
        people = entry.get("agents")
        if not isinstance(people, list) or not all(_is_person(each, "behaviour" in entry) for each in people):
            yield f"{pointer}/agents", "expected people with a position [x, y] and a goal"
    elif not is_point(entry.get("centre" if kind == "circle" else "origin")):
        yield f"{pointer}/{'centre' if kind == 'circle' else 'origin'}", "expected a point [x, y]"


def _seats_problems(entry, pointer):
    if ("front" in entry) == ("arc" in entry):
        yield pointer, "expected exactly one of `front` and `arc`"
    elif "front" in entry and not are_points(entry["front"], 2):
        yield f"{pointer}/front", "expected at least 2 points [x, y]"
    elif "arc" in entry and not (isinstance(entry["arc"], dict) and is_point(entry["arc"].get("centre"))):
        yield f"{pointer}/arc", "expected an object with a centre [x, y]"


def _all_points(document):
    for key, (shape, _) in _SHAPES.items():
        for entry in document.get(key, []):
            yield from ([entry["at"][:2]] if _is_empty(key, entry) else entry[shape])
    for entry in document.get("formations", []):
        yield from (entry[key] for key in ("centre", "origin") if is_point(entry.get(key)))
        for each in entry["agents"] if entry["type"] == "agents" else []:
            yield from _way_of(each)
    for entry in document.get("seats", []):
        yield from entry["front"] if "front" in entry else [entry["arc"]["centre"]]


def _origin(document):
    """What is taken off coordinates that are too large for single floats."""
    points = list(_all_points(document))
    if not points or max(max(abs(x), abs(y)) for x, y in points) < _FAR:
        return (0.0, 0.0)
    return tuple(math.floor(0.5 * (min(values) + max(values))) * 1.0 for values in zip(*points))


class ImportWorld:
    """Objects by their names in the layout; lines and points become objects, the same line once."""

    def __init__(self, collection, origin):
        self.collection, self.origin = collection, origin
        self.objects = {key: {} for key in LISTS.values()}
        self._lines, self._points = {}, {}

    def find(self, text):
        if text in self.objects["areas"]:
            return self.objects["areas"][text], "start"
        name, _, end = text.rpartition(":")
        return (self.objects["roads"][name], end) if end in ("start", "end") and name in self.objects["roads"] else None

    def level(self, text):
        return self.objects["levels"].get(text) if isinstance(text, str) else None

    def wall(self, text):
        return self.objects["walls"].get(text)

    def member(self, text):
        return self.objects["formations"].get(text) or self.block(text)

    def block(self, text):
        return self.objects["seats"].get(text)

    def local(self, points):
        return [(x - self.origin[0], y - self.origin[1]) for x, y in points]

    def line(self, raw):
        key = json.dumps(raw)
        if key not in self._lines:
            self._lines[key] = self.add(geometry.new_curve("Line", self.local(raw), False), "LINE")
        return self._lines[key]

    def point(self, raw):
        key = json.dumps(raw)
        if key not in self._points:
            empty = bpy.data.objects.new("Point", None)
            empty.location = (*self.local([raw])[0], 0.0)
            self._points[key] = self.add(empty, "POINT")
        return self._points[key]

    def add(self, thing, kind):
        thing.throng_layout.kind = kind
        thing.hide_render = True
        self.collection.objects.link(thing)
        return thing


def _shaped(world, key, kind, entry):
    # Named when it is made: giving it a name later would take that away from another object.
    name = entry["id"] if isinstance(entry.get("id"), str) and entry["id"] else kind.capitalize()
    if kind == "FORMATION":
        thing = bpy.data.objects.new(name, bpy.data.meshes.new("Throng formation"))
        if entry["type"] == "agents":
            geometry.fill_people(thing.data, [world.local(_way_of(each)) for each in entry["agents"]])
        else:
            thing.location = (*world.local([entry["centre" if entry["type"] == "circle" else "origin"]])[0], 0.0)
            turn = entry.get("rotation") if entry["type"] == "grid" else None
            thing.rotation_euler.z = math.radians(turn) if is_number(turn) else 0.0
        return thing
    if kind == "SEATS":
        if "arc" in entry:
            return geometry.new_arc(name, *world.local([entry["arc"]["centre"]]))
        return geometry.new_curve(name, world.local(entry["front"]), False)
    if _is_empty(key, entry):
        thing = bpy.data.objects.new(name, None)
        thing.location = (*world.local([entry["at"][:2]])[0], (*entry["at"], 0.0)[2])
        return thing
    closed = kind in ("AREA", "PATCH", "LEVEL") or (kind == "WALL" and entry.get("closed") is True)
    thing = geometry.new_curve(name, world.local(entry[_SHAPES[key][0]]), closed)
    if kind == "LEVEL":
        thing.location.z = levels.height_of(entry)
    return thing


def _put_formation(part, entry, world):
    part.type = entry["type"]
    codecs.put_all((*fields.FORMATION[part.type], places.BEHAVIOUR), part, entry, world)
    if part.type == "grid":
        places.put_goal(part, entry.get("goal", MISSING), world)


def _put_seats(part, entry, world):
    part.shape = "ARC" if "arc" in entry else "LINE"
    codecs.put_all(fields.ARC, part, entry.get("arc", {}))
    codecs.put_all(seats.SEATS, part, entry, world)


def _add_objects(world, document):
    things = []
    for kind, key in LISTS.items():
        for order, entry in enumerate(document.get(key, [])):
            thing = world.add(_shaped(world, key, kind, entry), kind)
            if isinstance(entry.get("id"), str):
                world.objects[key].setdefault(entry["id"], thing)
            part = thing.throng_layout
            part.imported_name, part.order = thing.name, order
            part.raw = json.dumps(entry, separators=(",", ":"))
            things.append((thing, kind, entry))
    for thing, kind, entry in things:  # goals speak of places, which are all there by now
        part = thing.throng_layout
        if kind in levels.ON_LEVELS:
            levels.put_level(thing, entry, world)
        if kind == "LINK" and thing.type == "CURVE":
            levels.put_link(part.link, entry, world)
            if part.link.begins is not None:
                thing.location.z = part.link.begins.location.z
        elif kind == "FORMATION":
            _put_formation(part.formation, entry, world)
        elif kind == "SEATS":
            _put_seats(part.seats, entry, world)
        elif kind == "PATCH":
            codecs.put_all(fields.PATCH, part.patch, entry)
        elif kind in ("ROAD", "WALL"):
            codecs.put_all(fields.ROAD if kind == "ROAD" else fields.OPEN_WALL, part, entry)
    return [thing for thing, _, _ in things]


def authored(scene):
    return [thing for thing in scene.objects if thing.throng_layout.kind != "NONE"]


def clear(scene):
    """Takes the layout out of the scene; the user's own meshes stay and are only unmarked."""
    for thing in authored(scene):
        if thing.type == "MESH" and thing.throng_layout.kind != "FORMATION":
            thing.throng_layout.kind = "NONE"
        else:
            stand = seat_drawing.stand_of(thing) if thing.throng_layout.kind == "SEATS" else None
            bpy.data.objects.remove(thing)
            seat_drawing.forget(stand)
    layout = scene.throng_layout
    for group in (layout.behaviours, layout.flows, layout.events, layout.given, layout.shows, layout.bars,
                  layout.problems):
        group.clear()
    for name in ("raw", "source", "origin", "name"):
        setattr(layout, name, "")
    layout.crowd = layout.built = None  # they stay in the scene, and are another layout's from now on


def layout_collection(scene):
    """Where parts of the layout are kept."""
    found = next((each for each in scene.collection.children_recursive if each.get("throng_layout")), None)
    if found is None:
        found = bpy.data.collections.new(COLLECTION)
        found["throng_layout"] = True
        scene.collection.children.link(found)
    return found


def is_empty(scene):
    layout = scene.throng_layout
    return not (authored(scene) or len(layout.behaviours) or len(layout.flows) or len(layout.events)
                or len(layout.given) or len(layout.shows))


def import_layout(context, path, replace=False):
    """Puts a layout into the scene. Raises AuthoringError before anything is changed."""
    scene = context.scene
    document = read_layout(path)
    if not is_empty(scene) and not replace:
        raise AuthoringError("there is a layout in this scene already: replace it, or import into a new scene")
    clear(scene)
    layout, origin = scene.throng_layout, _origin(document)
    world = ImportWorld(layout_collection(scene), origin)
    layout.raw = json.dumps({key: [] if key in LISTED else value for key, value in document.items()})
    layout.origin, layout.source = json.dumps(origin), os.path.abspath(path)
    layout.name = document["name"] if isinstance(document.get("name"), str) else ""
    with display.quietly():
        things = _add_objects(world, document)
        for codec in fields.SETTINGS:
            codec.put(layout, document.get(codec.key, MISSING))
        for behaviour in document.get("behaviours", []):
            behaviours.put_behaviour(layout.behaviours.add(), behaviour, world)
        for flow in document.get("flows", []):
            places.put_flow(layout.flows.add(), flow, world)
        for event in document.get("events", []):
            places.put_event(layout.events.add(), event, world)
        for entry in document.get("given", []):
            given.put_given(layout.given.add(), entry, world)
        for show in document.get("shows", []):
            seats.put_show(layout.shows.add(), show, world)
        places.put_expect(layout, document.get("expect", MISSING), world)
    for thing in things:
        display.refresh(thing)
    context.view_layer.update()
    return things


def next_order(scene):
    orders = [part.throng_layout.order for kind in LISTS for part in parts_of(scene, kind)]
    return max((order for order in orders if order < 2**30), default=-1) + 1
