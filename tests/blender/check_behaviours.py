# SPDX-License-Identifier: Apache-2.0
"""Runs inside Blender: one change after another to behaviours, each to a layout that was just imported, and the layout
that comes of it. ADDON LAYOUT FOLDER"""
import json
import os
import sys

import bpy

addon, layout, folder = sys.argv[-3:]
sys.path.insert(0, addon)
import throng  # noqa: E402
from throng.authoring.common_properties import groups_in, offered  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
throng.register()
things = bpy.data.objects
data = lambda: bpy.context.scene.throng_layout
state = lambda name: data().behaviours["visitor"].states[name]


def change(where, action="ADD", index=-1):
    assert bpy.ops.throng.list(where=where, action=action, index=index) == {"FINISHED"}


def rename_area():
    things["stall-2"].name = "flowers"


def rename_state():
    state("shop").name = "browse"


def rename_behaviour():
    data().behaviours["visitor"].name = "guest"


def change_what_is_done():
    here = state("shop")
    here.does = "gather"
    here.to.mode = "NEAREST"


def clap_there():
    state("shop").pose = "clap"


def sit_down():
    here = state("shop")
    here.does, here.pose = "sit", "cheer"
    for name in ("south", "east"):
        here.seats.add().name = name


def change_times():
    state("shop").lasts.b = 12.0
    state("shop").most = 3


def add_a_rule():
    change("behaviours[0].states[1].until")
    rule = state("shop").until[-1]
    rule.then = "leave"
    for number in range(3):
        change("behaviours[0].states[1].until[0].conditions")
    crowded, near, empty = rule.conditions
    crowded.kind, crowded.number = "crowded", 2.5
    near.kind, near.number = "near", 4.0
    near.who.add().name = "from the west"
    empty.kind, empty.place.target = "empty", things["square"]
    empty.who.add().name = "from the west"


def remove_a_rule():
    change("behaviours[0].states[0].until", "REMOVE", 0)


def rename_flow_in_a_rule():
    add_a_rule()
    data().flows["from the west"].name = "westerners"


def rename_to_a_name_that_is_taken():
    state("shop").name = "leave"
    assert [each.name for each in data().behaviours["visitor"].states] == ["stroll", "leave.001", "leave"]
    state("leave.001").name = ""
    assert state("leave.001").known == "leave.001"


def add_a_condition_twice():
    for _ in range(2):
        change("behaviours[0].states[0].until[0].conditions")
    kinds = [each.kind for each in state("stroll").until[0].conditions]
    assert len(set(kinds)) == 3 and kinds[0] == "after"
    state("stroll").until[0].conditions[1].kind = "after"
    assert len({each.kind for each in state("stroll").until[0].conditions}) == 3


def draw_one():
    """From nothing, as an artist does."""
    change("behaviours")
    made = data().behaviours[-1]
    made.name = "idler"
    for _ in range(2):
        change("behaviours[1].states")
    first, second = made.states
    first.name, first.does, first.place.target = "stroll", "wander", things["square"]
    change("behaviours[1].states[0].until")
    change("behaviours[1].states[0].until[0].conditions")
    rule = first.until[0]
    rule.conditions[0].kind = "after"
    rule.conditions[0].time.kind, rule.conditions[0].time.a, rule.conditions[0].time.b = "uniform", 3.0, 9.0
    second.name = "go home"
    rule.then = "go home"
    second.does, second.to.mode = "walk_to", "NEAREST"
    for name in ("west", "east"):
        second.to.places.add().target = things[name]
    data().flows["from the west"].behaviour = "idler"


def give_a_flow_a_behaviour():
    assert bpy.ops.throng.add_flow(count=5) == {"FINISHED"}
    flow = data().flows[-1]
    flow.source.target, flow.to.place.target = things["west"], things["east"]
    flow.behaviour = "visitor"


def follow_given_people():
    """Whom a field offers; and who speaks of somebody by name follows a new one."""
    change("given")
    here, given = state("shop"), data().given[-1]
    here.does, here.followed.name = "follow", given.name
    change("events")
    data().events[-1].kind = "go_to"
    data().events[-1].who.add().name = given.name
    offers["none typed"] = offered(groups_in(bpy.context.scene), "")
    offers["some typed"] = offered(groups_in(bpy.context.scene), "GIV")
    given.name = "leader"


EDITS = (rename_area, rename_state, rename_behaviour, change_what_is_done, clap_there, sit_down, change_times,
         add_a_rule, remove_a_rule, rename_flow_in_a_rule, rename_to_a_name_that_is_taken, add_a_condition_twice,
         draw_one, give_a_flow_a_behaviour, follow_given_people)
found, offers = {}, {}
for edit in EDITS:
    assert bpy.ops.import_scene.throng_layout(filepath=layout, replace=True) == {"FINISHED"}
    edit()
    path = os.path.join(folder, f"{edit.__name__}.json")
    assert bpy.ops.export_scene.throng_layout(filepath=path) == {"FINISHED"}
    with open(path, encoding="utf-8") as file:
        found[edit.__name__] = json.load(file)
print("RESULT " + json.dumps([found, offers]))
