# SPDX-License-Identifier: Apache-2.0
"""What the artist edits: properties of objects (roads, areas, walls, formations) and of the scene (flows,
events, simulation, bars).

Limits are soft: a layout may hold anything, and `throng check` says what is wrong with it, at the thing that is wrong.
"""
import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty,
                       PointerProperty, StringProperty)

from . import behaviour_properties, common_properties, display, fields, levels, people_properties, seat_properties
from .behaviour_properties import ThrongBehaviour, group_named
from .codecs import Flag, Whole
from .common_properties import (
    Named, ThrongDestination, ThrongDistribution, ThrongGoal, ThrongMember, ThrongPlace, is_kind, words_items)
from .fields import limits
from .geometry import top_of
from .people_properties import ThrongPeople
from .seat_properties import ThrongSeats, ThrongShow

KINDS = (("NONE", "None", "No part of the layout"), ("ROAD", "Road", "A curve with a width, on which people walk"),
         ("AREA", "Area", "A cyclic curve or a mesh: a plaza, an entry, an exit"),
         ("WALL", "Wall", "An open curve with a thickness, a cyclic one, or a mesh"),
         ("PATCH", "Patch", "A cyclic curve or a mesh: ground that people avoid, walk on at another pace, or take "
                            "another room on"),
         ("SEATS", "Seats", "A curve: the first row of a block of seats, with further ones to its right"),
         ("FORMATION", "Formation", "People who stand here at a given moment"),
         ("LEVEL", "Level", "A cyclic curve or a mesh at its height: a floor on which people walk above others"),
         ("LINK", "Link", "A curve from one level to another: stairs, a ramp, an escalator; with landings at its "
                          "corners"),
         ("LINE", "Line", "A queue, a mirror, the corners of a box, or where people are counted"),
         ("POINT", "Point", "Something to look at"))


def _refresh(group, _context):
    display.refresh(group.id_data)


def _show_solid(layout, _context):
    for thing in layout.id_data.objects:
        if thing.type == "CURVE" and thing.throng_layout.kind in display.DRAWN:
            thing.display_type = "TEXTURED" if layout.show_solid else "WIRE"


_ARRIVAL = [("leave", "Leave", "People leave the scene at their goal"), ("stay", "Stay", "People stay and stand there")]


class ThrongStop(bpy.types.PropertyGroup):
    raw: StringProperty(options={"HIDDEN"})
    at: PointerProperty(type=ThrongDestination)
    wait: PointerProperty(type=ThrongDistribution, name="Wait",
                          description="How long people stop, s; in a queue, how long one is served")
    activity: EnumProperty(name="Activity",
                           items=[("gather", "Gather", "Everybody stands at a spot of their own"),
                                  ("look", "Look", "The same, looking at something"),
                                  ("queue", "Queue", "People stand in line, and the first one is served")])
    facing: PointerProperty(type=bpy.types.Object, name="Facing", poll=is_kind("POINT"),
                            description="What people look at")
    line: PointerProperty(type=bpy.types.Object, name="Line", poll=is_kind("LINE"),
                          description="Where people queue, from the front on")
    spacing: FloatProperty(name="Spacing", **limits("stop", "spacing"),
                           description="Queue: metres from one to the next")


class ThrongFlow(Named, bpy.types.PropertyGroup):
    raw: StringProperty(options={"HIDDEN"})
    source: PointerProperty(type=ThrongPlace, name="From")
    to: PointerProperty(type=ThrongGoal, name="To")
    via: CollectionProperty(type=ThrongStop)
    active_stop: IntProperty()
    amount: EnumProperty(name="How Many", items=[("COUNT", "Count", "People in all, spread evenly"),
                                                 ("RATE", "Rate", "People a second, at random moments"),
                                                 ("KEPT", "As Loaded", "At the moments, or with the gaps, that the "
                                                                       "layout tells")])
    count: IntProperty(name="People", **limits("flow", "count"))
    rate: FloatProperty(name="People/s", **limits("flow", "rate", soft_max=1000.0))
    start: FloatProperty(name="Start", **limits("flow", "start"), description="When the first come, s")
    use_end: BoolProperty(name="End", description="Otherwise people come until the shot ends")
    end: FloatProperty(name="End", **limits("flow", "end"), description="When the last come, s")
    people: PointerProperty(type=ThrongPeople)
    arrival: EnumProperty(name="Arrival", items=_ARRIVAL)
    behaviour: StringProperty(name="Behaviour", description="In place of where they go")

    def renamed(self, before):
        layout = self.id_data.throng_layout
        for event in layout.events:
            if event.flow == before:
                event.flow = self.name
        group_named(layout, before, self.name)


class ThrongEvent(bpy.types.PropertyGroup):
    raw: StringProperty(options={"HIDDEN"})
    kind: EnumProperty(name="What", items=[("open", "Open", "A wall is gone from now on"),
                                           ("close", "Close", "A wall is there from now on"),
                                           ("go_to", "Go to", "People leave what they do and go there"),
                                           ("flow", "Flow", "A flow changes its rate")])
    time: FloatProperty(name="At", **limits("event", "at"), description="When, s")
    wall: PointerProperty(type=bpy.types.Object, name="Wall", poll=is_kind("WALL"))
    text: StringProperty(name="By Name", description="A wall that is no object of this scene")
    destination: PointerProperty(type=ThrongDestination)
    who: CollectionProperty(type=ThrongMember)
    arrival: EnumProperty(name="Arrival", items=_ARRIVAL)
    flow: StringProperty(name="Flow")
    rate: FloatProperty(name="People/s", **limits("event", "rate", soft_max=1000.0))


class ThrongBar(bpy.types.PropertyGroup):
    figure: EnumProperty(name="Figure", items=words_items(fields.BARS))
    use_least: BoolProperty(name="At Least")
    least: FloatProperty(name="At Least")
    use_most: BoolProperty(name="At Most")
    most: FloatProperty(name="At Most")


class ThrongFormation(bpy.types.PropertyGroup):
    type: EnumProperty(name="Type", update=_refresh,
                       items=[("circle", "Circle", "Evenly on a circle, everybody's goal the opposite point"),
                              ("grid", "Grid", "Rows and columns"),
                              ("agents", "List", "An edge for each person, from where they stand to their goal")])
    radius: FloatProperty(name="Radius", **limits("formation", "radius", soft_min=0.1), subtype="DISTANCE",
                          update=_refresh)
    count: IntProperty(name="People", **limits("formation", "count"), update=_refresh)
    use_ring_spacing: BoolProperty(name="Rings", update=_refresh)
    ring_spacing: FloatProperty(name="Ring Spacing", **limits("formation", "ring_spacing", soft_min=0.1),
                                subtype="DISTANCE", update=_refresh,
                                description="Further rings outside the first, this far apart")
    use_along: BoolProperty(name="Along", update=_refresh)
    along: FloatProperty(name="Along", **limits("formation", "along", soft_min=0.1), subtype="DISTANCE",
                         update=_refresh,
                         description="Between neighbours on a ring")
    rows: IntProperty(name="Rows", **limits("formation", "rows"), update=_refresh)
    columns: IntProperty(name="Columns", **limits("formation", "columns"), update=_refresh)
    use_people_count: BoolProperty(name="Fewer", update=_refresh)
    people_count: IntProperty(name="People", **limits("formation", "count"), update=_refresh,
                              description="At most this many, column by column")
    spacing: FloatProperty(name="Spacing", **limits("formation", "spacing", soft_min=0.1), subtype="DISTANCE",
                           update=_refresh)
    jitter: FloatProperty(name="Jitter", **limits("formation", "jitter"), subtype="DISTANCE",
                          description="Each coordinate moves by up to this much (not shown)")
    goal_kind: EnumProperty(name="Goal", items=[("PLACE", "Places", "One place, the nearest, or a choice"),
                                                ("OFFSET", "Offset", "Everybody's position plus this"),
                                                ("MIRROR", "Mirror", "Mirrored at a line of two points"),
                                                ("ANYWHERE", "Anywhere", "In a box between the two ends of a line")])
    goal: PointerProperty(type=ThrongGoal)
    goal_offset: FloatVectorProperty(name="Offset", size=2, subtype="XYZ")
    goal_line: PointerProperty(type=bpy.types.Object, name="Line", poll=is_kind("LINE"))
    start: FloatProperty(name="Start", **limits("formation", "start"), description="When they appear, s")
    wait: PointerProperty(type=ThrongDistribution, name="Wait",
                          description="How long people stand before they set off, s")
    people: PointerProperty(type=ThrongPeople)
    arrival: EnumProperty(name="Arrival", items=_ARRIVAL, default="stay")
    goal_tolerance: FloatProperty(name="Goal Tolerance", **limits("formation", "goal_tolerance"),
                                  description="This near to a point goal is arrived, m")
    behaviour: StringProperty(name="Behaviour", description="In place of where they go")


class ThrongGiven(Named, bpy.types.PropertyGroup):
    """People whose ways are given."""

    raw: StringProperty(options={"HIDDEN"})
    source: EnumProperty(name="Ways", items=[
        ("FILE", "File", "Trajectories: CSV, the archive of Juelich, a JuPedSim database, or a bake's folder"),
        ("WAYS", "As Loaded", "The points that the layout tells")])
    file: StringProperty(name="File", subtype="FILE_PATH", description="Trajectories; a name alone lies beside the "
                                                                       "layout that was imported")
    use_fps: BoolProperty(name="Frame Rate", description="Of a file that has frames and does not say so itself")
    fps: FloatProperty(name="Frame Rate", **limits("given", "fps"), description="Frames a second")
    start: FloatProperty(name="Start", **limits("given", "start"), description="Added to all times, s")
    offset: FloatVectorProperty(name="Offset", size=2, subtype="XYZ", description="Added to all places, m")
    people: PointerProperty(type=ThrongPeople)

    def renamed(self, before):
        group_named(self.id_data.throng_layout, before, self.name)


class ThrongPatch(bpy.types.PropertyGroup):
    use_cost: BoolProperty(name="Cost", default=True, description="Otherwise as much as being slow there costs")
    cost: FloatProperty(name="Cost", **limits("patch", "cost"),
                        description="How many metres of another way one metre of it is worth")
    pace: FloatProperty(name="Pace", **limits("patch", "pace"),
                        description="How fast people walk there, times their preferred speed")
    room: FloatProperty(name="Size", **limits("patch", "size"),
                        description="How much room bodies take there, times their own size")
    begins: FloatProperty(name="From", **limits("patch", "from"), description="From when it holds, s; 0: always")
    use_ends: BoolProperty(name="Until", description="Otherwise it holds to the end")
    ends: FloatProperty(name="Until", **limits("patch", "until"), description="Until when it holds, s")


def _follow_level(part, _context):
    """What is on a level is drawn at its height."""
    thing = part.id_data
    if part.level is not None and part.kind in levels.ON_LEVELS:
        thing.location.z = top_of(part.level)


class ThrongLink(bpy.types.PropertyGroup):
    type: EnumProperty(name="Type", items=words_items(fields.LINK_TYPES), update=_refresh)
    begins: PointerProperty(type=bpy.types.Object, name="From", poll=is_kind("LEVEL"), update=_refresh,
                            description="The level on which its curve begins")
    ends: PointerProperty(type=bpy.types.Object, name="To", poll=is_kind("LEVEL"), update=_refresh,
                          description="The level on which its curve ends")
    width: FloatProperty(name="Width", **limits("link", "width"), subtype="DISTANCE", update=_refresh,
                         description="Between its railings; of an escalator or travelator, of its steps")
    speed: FloatProperty(name="Speed", **limits("link", "speed"), description="Of ground that moves, along its slope, "
                                                                              "m/s")
    walking: FloatProperty(name="Walking", **limits("link", "walking"),
                           description="Share of its people who walk on ground that moves")
    stand: EnumProperty(name="Stand", items=words_items(("anywhere", "right", "left")),
                        description="On which side those stand who do not walk")


class ThrongObject(bpy.types.PropertyGroup):
    """Marks an object as a part of the layout. Its name is its id there."""

    kind: EnumProperty(name="Kind", items=KINDS, update=_refresh)
    raw: StringProperty(options={"HIDDEN"})
    imported_name: StringProperty(options={"HIDDEN"})
    order: IntProperty(options={"HIDDEN"}, default=2**30)
    width: FloatProperty(name="Width", **limits("road", "width"), subtype="DISTANCE", update=_refresh)
    one_way: BoolProperty(name="One Way", update=_refresh, description="Walked from the first point to the last only")
    thickness: FloatProperty(name="Thickness", **limits("wall", "thickness"), subtype="DISTANCE", update=_refresh)
    height: FloatProperty(name="Height", **limits("wall", "height"), subtype="DISTANCE", update=_refresh)
    formation: PointerProperty(type=ThrongFormation)
    patch: PointerProperty(type=ThrongPatch)
    link: PointerProperty(type=ThrongLink)
    level: PointerProperty(type=bpy.types.Object, name="Level", poll=is_kind("LEVEL"), update=_follow_level,
                           description="The level on which it is; by default the first")
    seats: PointerProperty(type=ThrongSeats)


class ThrongSimulation(bpy.types.PropertyGroup):
    """Filled from the table of the simulation's settings."""


def _setting(codec, label, least, most, description):
    if isinstance(codec, fields.Choice):
        return EnumProperty(name=label, items=[(word, word, "") for word in codec.words], default=codec.default,
                            description=description)
    if isinstance(codec, Flag):
        return BoolProperty(name=label, default=codec.default, description=description)
    make = IntProperty if isinstance(codec, Whole) else FloatProperty
    return make(name=label, default=codec.default, soft_min=least, soft_max=most, description=description)


ThrongSimulation.__annotations__ = {row[0].key: _setting(*row) for row in fields.SIMULATION}


def _rule(name, rows):
    """The numbers of one rule of motion."""
    settings = {row[0].key: _setting(*row) for row in rows}
    return type(f"ThrongRule_{name}", (bpy.types.PropertyGroup,), {"__annotations__": settings})


_RULES = {name: _rule(name, rows) for name, _, _, rows in fields.MOTION}


class ThrongMotion(bpy.types.PropertyGroup):
    """A group of numbers for each rule, and which one is shown."""

    shown: EnumProperty(name="Rule", items=[(name, label, about) for name, label, about, _ in fields.MOTION])


ThrongMotion.__annotations__.update({name: PointerProperty(type=rule) for name, rule in _RULES.items()})


class ThrongProblem(bpy.types.PropertyGroup):
    """What `throng` said about the layout, and what it said it about."""

    message: StringProperty()
    hint: StringProperty()
    pointer: StringProperty()
    is_error: BoolProperty(default=True)
    target: PointerProperty(type=bpy.types.Object)
    where: StringProperty()   # flows, events: a list of the scene
    index: IntProperty(default=-1)


class ThrongScene(bpy.types.PropertyGroup):
    raw: StringProperty(options={"HIDDEN"})
    # the layout file that was imported: files that it names lie beside it
    source: StringProperty(options={"HIDDEN"}, subtype="FILE_PATH")
    origin: StringProperty(options={"HIDDEN"})  # [x, y] in doubles: what was taken off the layout's coordinates
    name: StringProperty(name="Name", description="Of the layout and its bakes; by default the .blend's")
    simulation: PointerProperty(type=ThrongSimulation)
    motion: PointerProperty(type=ThrongMotion)
    flows: CollectionProperty(type=ThrongFlow)
    active_flow: IntProperty()
    events: CollectionProperty(type=ThrongEvent)
    active_event: IntProperty()
    behaviours: CollectionProperty(type=ThrongBehaviour)
    active_behaviour: IntProperty()
    given: CollectionProperty(type=ThrongGiven)
    active_given: IntProperty()
    shows: CollectionProperty(type=ThrongShow)
    active_show: IntProperty()
    bars: CollectionProperty(type=ThrongBar)
    draw_on: PointerProperty(type=bpy.types.Object, name="Draw on", poll=is_kind("LEVEL"),
                             description="The level on which new parts are; by default the first")
    expect_line: PointerProperty(type=bpy.types.Object, name="Line", poll=is_kind("LINE"),
                                 description="Where people are counted for the bar on flow")
    tolerance: FloatProperty(name="Curve Tolerance", default=0.02, min=0.001, max=10.0, subtype="DISTANCE",
                             description="How far points on a Bezier curve may be off")
    show_flows: BoolProperty(name="Show Flows", default=True,
                             description="Draw flows in the viewport, from place to place")
    show_solid: BoolProperty(name="Show Drawing Solid", default=True, update=_show_solid,
                             description="Otherwise as wires: where streets and buildings were built, "
                                         "they show what was drawn")
    folder: StringProperty(name="Folder", default="//throng", subtype="DIR_PATH", description="Where bakes are written")
    crowd: PointerProperty(type=bpy.types.Object, description="The crowd that was baked from this layout")
    built: PointerProperty(type=bpy.types.Collection,
                           description="Streets and buildings that were built from this layout")
    build_streets: BoolProperty(name="Streets", default=True, description="Build roads and areas anew after each bake")
    build_walls: BoolProperty(name="Buildings", default=True,
                              description="Build walls anew after each bake; walls that are "
                                          "meshes are left as they are")
    build_scenery: BoolProperty(name="Ground and Light", default=True,
                                description="Add a ground, a sun and a sky with the first bake")
    build_camera: BoolProperty(name="Camera", default=True,
                               description="Add a camera with the first bake, if the scene has none")
    problems: CollectionProperty(type=ThrongProblem)
    progress: FloatProperty(subtype="PERCENTAGE", min=0.0, max=100.0, options={"SKIP_SAVE"})
    status: StringProperty(options={"SKIP_SAVE"})


CLASSES = (*common_properties.CLASSES, *behaviour_properties.CLASSES, *people_properties.CLASSES,
           *seat_properties.CLASSES, ThrongStop, ThrongFlow, ThrongEvent, ThrongBar, ThrongFormation, ThrongGiven,
           ThrongPatch, ThrongLink, ThrongObject, ThrongSimulation, *_RULES.values(), ThrongMotion, ThrongProblem,
           ThrongScene)

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def register():
    _register_classes()
    bpy.types.Object.throng_layout = PointerProperty(type=ThrongObject)
    bpy.types.Scene.throng_layout = PointerProperty(type=ThrongScene)


def unregister():
    del bpy.types.Scene.throng_layout
    del bpy.types.Object.throng_layout
    _unregister_classes()
