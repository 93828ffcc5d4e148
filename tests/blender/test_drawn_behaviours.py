# SPDX-License-Identifier: Apache-2.0
"""Behaviours drawn in a real Blender: what was changed is in the layout and nothing else, names are kept up, and what
is drawn from nothing is a layout that the program takes."""
import json

import pytest

from conftest import EXAMPLES
from results import ADDON, HERE, result_of
from test_authoring import differences

MARKET = EXAMPLES / "market.json"
STATES = "/behaviours/0/states"
EDITS = {
    "rename_area": {"/areas/4/id", f"{STATES}/shop/visit/1"},
    "rename_state": {f"{STATES}/shop", f"{STATES}/browse", f"{STATES}/stroll/until/0/then"},
    "rename_behaviour": {"/behaviours/0/id", "/flows/0/behaviour", "/flows/1/behaviour"},
    "change_what_is_done": {f"{STATES}/shop/{key}" for key in ("visit", "count", "gather")},
    "clap_there": {f"{STATES}/shop/do"},
    "sit_down": {f"{STATES}/shop/{key}" for key in ("visit", "count", "sit", "do")},
    "change_times": {f"{STATES}/shop/for/uniform/1", f"{STATES}/shop/count/1"},
    "add_a_rule": {f"{STATES}/shop/until"},
    "remove_a_rule": {f"{STATES}/stroll/until"},
    "rename_flow_in_a_rule": {f"{STATES}/shop/until", "/flows/0/id"},
    "rename_to_a_name_that_is_taken": {f"{STATES}/shop", f"{STATES}/leave.001", f"{STATES}/stroll/until/0/then"},
    "add_a_condition_twice": {f"{STATES}/stroll/until/0/{key}" for key in ("at", "arrived")},
    "draw_one": {"/behaviours/1", "/flows/0/behaviour"},
    "give_a_flow_a_behaviour": {"/flows/2"},
    "follow_given_people": {f"{STATES}/shop/{key}" for key in ("visit", "count", "for", "then", "follow")}
    | {"/given", "/events"},
}


@pytest.fixture(scope="module")
def drawn(blender, throng, tmp_path_factory):
    """(the market before, {edit: the market after it}, what was offered); the program takes whatever an artist
    draws."""
    folder = tmp_path_factory.mktemp("behaviours")
    after, offers = result_of(blender(HERE / "check_behaviours.py", ADDON, MARKET, folder))
    unfinished = ("remove_a_rule", "sit_down", "follow_given_people")
    throng("check", *(folder / f"{edit}.json" for edit in EDITS if edit not in unfinished))
    return json.loads(MARKET.read_text(encoding="utf-8")), after, offers


def test_changes_are_in_the_layout_and_nothing_else(drawn):
    before, after, _ = drawn
    assert {name: differences(before, layout) for name, layout in after.items()} == EDITS


def test_rules_say_what_was_chosen(drawn):
    after = drawn[1]
    shop = "shop"
    assert after["add_a_rule"]["behaviours"][0]["states"][shop]["until"] == [
        {"crowded": 2.5, "near": "from the west", "within": 4, "empty": "square", "of": "from the west",
         "then": "leave"}]
    rule = after["rename_flow_in_a_rule"]["behaviours"][0]["states"][shop]["until"][0]
    assert (rule["near"], rule["of"]) == ("westerners", "westerners")
    assert after["rename_state"]["behaviours"][0]["states"]["stroll"]["until"][0]["then"] == "browse"


def test_states_keep_what_other_activities_know_of_alone(drawn):
    states = drawn[1]["change_what_is_done"]["behaviours"][0]["states"]
    assert states["shop"]["gather"] == {"nearest": [f"stall-{number}" for number in range(1, 13)]}
    assert states["shop"]["for"] == {"uniform": [5, 10]} and states["shop"]["then"] == "leave"


def test_people_clap_where_they_stand_and_sit_in_seats(drawn):
    assert drawn[1]["clap_there"]["behaviours"][0]["states"]["shop"]["do"] == "clap"
    shop = drawn[1]["sit_down"]["behaviours"][0]["states"]["shop"]
    assert (shop["sit"], shop["do"]) == (["south", "east"], "cheer")


def test_given_people_are_offered_and_followed_by_name(drawn):
    _, after, offers = drawn
    flows = [["from the east", "flow"], ["from the west", "flow"]]
    assert offers["none typed"] == sorted([*flows, ["Given 1", "given people"]])
    assert offers["some typed"] == [["Given 1", "given people"]]
    layout = after["follow_given_people"]
    assert layout["behaviours"][0]["states"]["shop"] == {"follow": "leader"} and layout["given"][0]["id"] == "leader"
    assert layout["events"][-1]["who"] == ["leader"]


def test_a_behaviour_is_drawn_from_nothing(drawn):
    layout = drawn[1]["draw_one"]
    assert layout["behaviours"][1] == {
        "id": "idler", "start": "stroll",
        "states": {"stroll": {"wander": "square", "until": [{"after": {"uniform": [3, 9]}, "then": "go home"}]},
                   "go home": {"walk_to": {"nearest": ["west", "east"]}}}}
    assert layout["flows"][0]["behaviour"] == "idler"


def test_a_behaviour_takes_the_place_of_goals(drawn):
    assert drawn[1]["give_a_flow_a_behaviour"]["flows"][2] == {
        "id": "Flow 3", "from": "west", "behaviour": "visitor", "count": 5}
