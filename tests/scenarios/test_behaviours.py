# SPDX-License-Identifier: Apache-2.0
"""What people do by their behaviours: a market whose visitors choose stalls, a tram that people leave before others get
on, and gates, crowds and company that end what people do."""
import json

import numpy
import pytest

import written_bakes
from conftest import EXAMPLES, ROOT

WALKED, STOOD, LOOKED, QUEUED = 1, 2, 3, 4  # activities


def box(x, y, width, height):
    return [[x, y], [x + width, y], [x + width, y + height], [x, y + height]]


class Bake(written_bakes.Bake):
    def __init__(self, path, layout):
        super().__init__(path)
        self.layout, self.fps = layout, int(self.manifest["fps"])
        self.places, self.facing = self.pos[..., :2].astype(float), self.dir[..., :2].astype(float)
        self.doing = self.state[..., 0].astype(int)

    def of(self, group):
        return numpy.array([row["group"] == group for row in self.rows])

    def inside(self, area, slack=0.0):
        """Frames by rows: who is there and in an area that is a box."""
        polygon = numpy.array(next(each["polygon"] for each in self.layout["areas"] if each["id"] == area), float)
        lower, upper = polygon.min(axis=0) - slack, polygon.max(axis=0) + slack
        return ((self.places >= lower) & (self.places <= upper)).all(axis=-1) & (self.doing > 0)

    def spells(self, activity):
        """(row, first frame, last frame)"""
        for row, does in enumerate((self.doing == activity).T):
            edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[0], does, [0]])))
            yield from ((row, first, last - 1) for first, last in zip(edges[::2], edges[1::2], strict=True))


@pytest.fixture(scope="module")
def bake(throng, tmp_path_factory):
    made = written_bakes.baker(throng, tmp_path_factory.mktemp("behaviours"))
    return lambda name, layout, *options: Bake(made(name, layout, *options), layout)


@pytest.fixture(scope="module")
def market(bake):
    return bake("market", json.loads((EXAMPLES / "market.json").read_text("utf-8")))


def test_everybody_visits_two_to_four_stalls(market):
    stalls = [area["id"] for area in market.layout["areas"] if area["id"].startswith("stall")]
    inside = [market.inside(stall, slack=1.2) for stall in stalls]  # where a stall is full, people stand beside
    visited = [set() for _ in market.rows]
    for row, first, last in market.spells(LOOKED):
        middle = (first + last) // 2
        visited[row].update(stall for stall, there in zip(stalls, inside, strict=True) if there[middle, row])
    counts = numpy.array([len(each) for each in visited])
    assert counts.min() >= 2 and counts.max() <= 4, counts
    assert {2, 3, 4} == set(counts)
    assert min(sum(stall in each for each in visited) for stall in stalls) >= 10, "no stall is left out"


def test_who_looks_at_a_stall_stands_and_looks_at_it(market):
    facing = {area["id"]: area["facing"] for area in market.layout["areas"] if "facing" in area}
    inside = {stall: market.inside(stall) for stall in facing}
    drifts, cosines, seconds = [], [], []
    for row, first, last in market.spells(LOOKED):
        settled = first + round(0.5 * market.fps)
        if last <= settled:
            continue
        drifts.append(numpy.linalg.norm(market.places[last, row] - market.places[settled, row]))
        seconds.append((last - first) / market.fps)
        stall = next((each for each in facing if inside[each][last, row]), None)
        if stall:
            sight = numpy.array(facing[stall]) - market.places[last, row]
            cosines.append(sight @ market.facing[last, row] / numpy.linalg.norm(sight))
    assert len(drifts) > 300
    assert numpy.median(drifts) < 0.1, numpy.median(drifts)
    assert numpy.percentile(cosines, 10) > 0.9, numpy.percentile(cosines, 10)
    assert 4.5 < numpy.percentile(seconds, 5) and numpy.percentile(seconds, 95) < 12.6


def test_they_stroll_in_the_square_first_and_all_leave(market):
    assert {row["outcome"] for row in market.rows} == {"arrived"}
    assert (market.doing[-1] > 0).mean() < 0.02
    entered = (market.doing > 0).argmax(axis=0)
    first_look = (market.doing == LOOKED).argmax(axis=0)
    strolls = (first_look - entered) / market.fps
    assert strolls.min() > 5
    assert numpy.median(strolls) > 12


def test_a_bake_repeats_and_another_seed_is_another_crowd(bake):
    layout = json.loads((ROOT / "docs" / "examples" / "behaviours.json").read_text("utf-8"))
    layout["simulation"]["duration"] = 20
    one, same = bake("one", layout), bake("same", layout)
    assert (one.places == same.places).all() and (one.doing == same.doing).all()
    other = bake("other", layout, "--set", "simulation.seed=9")
    assert one.places.shape != other.places.shape or (one.places != other.places).any()


def test_those_inside_a_tram_get_off_before_others_get_on(bake):
    tram = bake("tram", json.loads((ROOT / "docs" / "examples" / "boarding.json").read_text("utf-8")))
    riders, inside = tram.of("riders"), tram.inside("tram", slack=0.15)
    opens = 15 * tram.fps
    assert inside[:opens, riders].all(), "they wait for the doors"
    assert not inside[:opens, ~riders].any()
    last_out = numpy.flatnonzero(inside[:, riders].any(axis=1)).max()
    first_in = numpy.flatnonzero(inside[:, ~riders].any(axis=1)).min()
    assert first_in > last_out, (first_in, last_out)
    assert (first_in - last_out) / tram.fps < 4
    assert inside[-1, ~riders].mean() == 1
    assert not (tram.doing[-1, riders] > 0).any()


def conditions(until, then="go", extra=None, people=6):
    """People stand in a row until something happens, and then walk away eastwards."""
    return {"throng": 1, "simulation": {"duration": 20},
            "areas": [{"id": "away", "polygon": box(14, -8, 3, 16)}, {"id": "here", "polygon": box(-4, -4, 14, 8)}],
            "behaviours": [{"id": "waits", "start": "stand", "states": {
                "stand": {"stay": True, "until": [{**until, "then": then}]}, "go": {"walk_to": "away"}}}],
            "formations": [{"id": "row", "type": "grid", "origin": [0, 0], "rows": 1, "columns": people, "spacing": 1.2,
                            "behaviour": "waits"}, *(extra or [])]}


def setting_off(baked, group="row"):
    """s, when each first walks faster than 0.5 m/s; NaN for who never does."""
    speeds = numpy.linalg.norm(numpy.diff(baked.places[:, baked.of(group)], axis=0), axis=-1) * baked.fps
    return numpy.where((speeds > 0.5).any(axis=0), (speeds > 0.5).argmax(axis=0) / baked.fps, numpy.nan)


def test_a_time_of_the_shot_ends_it_for_each_at_their_own(bake):
    times = setting_off(bake("times", conditions({"at": {"uniform": [3, 9]}}, people=8)))
    assert times.min() > 2.8 and times.max() < 10.2 and times.std() > 0.7, times


@pytest.mark.parametrize("condition, at", [({"green": "zebra"}, 6.0), ({"red": "street"}, 4.0)])
def test_a_signal_ends_it(bake, condition, at):
    """A cycle of 4 s for the street, 2 s for nobody, and the rest for people."""
    layout = conditions(condition)
    layout["crossings"] = [{"id": "zebra", "polygon": box(10, -8, 4, 16)}]
    layout["lanes"] = [{"id": "street", "points": [[12, -40], [12, 40]],
                        "stops": [{"at": [12, -9], "signal": "lights"}]}]
    layout["signals"] = [{"id": "lights", "phases": [
        {"seconds": 4, "green": ["street"]}, {"seconds": 2}, {"seconds": 30, "green": ["zebra"]}]}]
    times = setting_off(bake(f"signal {at}", layout))
    assert times.min() > at - 0.1 and times.max() < at + 1.2, times


def test_people_are_served_in_the_order_in_which_they_came_again_and_again(bake):
    """More often than there are people: who has been served comes back to the end of the line."""
    layout = conditions({"after": 100})
    layout["simulation"]["duration"] = 90
    layout["behaviours"][0].update(start="line", states={
        "line": {"queue": "here", "line": [[8, 0], [-3, 0]], "spacing": 0.8, "for": 3, "then": "walk"},
        "walk": {"gather": "away", "for": 1, "then": "line"}})
    baked = bake("queue", layout)
    waits = [each for each in baked.spells(QUEUED) if each[2] < len(baked.doing) - 1]  # who was served by then
    served = sorted(waits, key=lambda each: each[2])
    assert len(waits) > 12 and (numpy.diff([first for _, first, _ in served]) >= 0).all(), served
    between = numpy.diff([last for _, _, last in served]) / baked.fps
    assert between.min() > 2.9 and numpy.median(between) < 6.0, between
    first = baked.places[served[0][2], served[0][0]]
    assert numpy.linalg.norm(first - [8, 0]) < 0.5, "one is served at the front"


def test_who_changes_lines_holds_up_nobody(bake):
    """Seven stand in each line; the eighth of one becomes the eighth of the other, with the same number."""
    def queue(place, y, seconds, **more):
        return {"queue": place, "line": [[1, y], [13, y]], "for": seconds, "then": "off", **more}

    def standing(group, behaviour, places, **more):
        return {"id": group, "type": "agents", "behaviour": behaviour,
                "agents": [{"position": place} for place in places], **more}

    off = {"walk_to": "out"}
    layout = {"throng": 1, "simulation": {"duration": 80, "fps": 10},
              "areas": [{"id": "a", "polygon": box(0, -2, 14, 4)}, {"id": "b", "polygon": box(0, 4, 14, 4)},
                        {"id": "out", "polygon": box(-10, -10, 2, 4)}],
              "behaviours": [
                  {"id": "first", "start": "q", "states": {"q": queue("a", 0, 4), "off": off}},
                  {"id": "second", "start": "q", "states": {"q": queue("b", 6, 40), "off": off}},
                  {"id": "change", "start": "q", "states": {
                      "q": queue("a", 0, 4, until=[{"after": 22, "then": "b"}]), "b": queue("b", 6, 30), "off": off}}],
              "formations": [standing("seven", "first", [[2 + i, 0] for i in range(7)]),
                             standing("changes", "change", [[9, 0.5]]),
                             standing("last", "first", [[11 + i, 0.5] for i in range(3)], start=10),
                             standing("others", "second", [[2 + i, 6] for i in range(7)])]}
    baked = bake("lines", layout)
    assert (baked.doing[-1, baked.of("last")] == 0).all(), "they have been served, and are gone"


def test_queues_are_on_other_levels_too(throng, tmp_path):
    (tmp_path / "layout.json").write_text(json.dumps({
        "throng": 1, "simulation": {"duration": 4},
        "levels": [{"id": "ground", "height": 0, "floor": box(0, 0, 14, 20)},
                   {"id": "upper", "height": 4, "floor": box(20, 0, 30, 20)}],
        "links": [{"id": "stairs", "from": "ground", "to": "upper", "path": [[14, 10], [20, 10]], "width": 3}],
        "areas": [{"id": "in", "level": "upper", "polygon": box(21, 1, 7, 7)},
                  {"id": "till", "level": "upper", "polygon": box(42, 1, 7, 7)}],
        "behaviours": [{"id": "b", "start": "line", "states": {
            "line": {"queue": "till", "line": [[43, 2], [43, 7]], "for": 3, "then": "off"}, "off": {"walk_to": "in"}}}],
        "flows": [{"id": "people", "from": "in", "behaviour": "b", "count": 5}]}))
    throng("check", tmp_path / "layout.json")


def test_somebody_who_comes_near_ends_it(bake):
    passer = {"id": "passer", "type": "agents", "agents": [{"position": [-10, 1.6], "goal": [12, 1.6], "speed": 1.3}]}
    times = setting_off(bake("near", conditions({"near": "passer", "within": 2.5}, extra=[passer])))
    assert (numpy.diff(times) > 0).all(), "one after the other, as it passes"
    assert 5 < times[0] < 8, times


def test_a_share_per_second_goes(bake):
    times = setting_off(bake("chance", conditions({"chance": 0.2}, people=60)))
    gone = [numpy.nansum(times < second) / 60 for second in (5, 10, 19)]
    for share, second in zip(gone, (5, 10, 19), strict=True):
        assert abs(share - (1 - 0.8 ** (second - 0.4))) < 0.15, gone


def test_nobody_goes_before_all_are_here(bake):
    late = {"id": "row2", "type": "grid", "origin": [-20, 0], "rows": 1, "columns": 2, "behaviour": "comes"}
    layout = conditions({"all_here": "here"}, extra=[late])
    layout["behaviours"].append({"id": "comes", "start": "come", "states": {
        "come": {"gather": "here", "until": [{"all_here": "here", "then": "go"}]}, "go": {"walk_to": "away"}}})
    baked = bake("all here", layout)
    assert numpy.nanmax(setting_off(baked)) < 1, "all of the row are here at once"
    both = baked.inside("here")[:, baked.of("row2")].all(axis=1)
    arrived = baked.inside("away")[:, baked.of("row2")].any(axis=1)
    assert both.any() and not arrived[:both.argmax()].any()


def test_who_follows_somebody_is_where_it_went(bake):
    layout = conditions({"after": 100})
    layout["behaviours"] = [{"id": "waits", "start": "follow", "states": {
        "follow": {"follow": "guide", "distance": 2, "until": [{"after": 100, "then": "go"}]},
        "go": {"walk_to": "away"}}}]
    layout["formations"].append({"id": "guide", "type": "agents", "agents": [
        {"position": [9, 0], "goal": [9, 18], "speed": 1.0}]})
    baked = bake("follow", layout)
    guide = baked.places[-1, baked.of("guide")][0]
    away = numpy.linalg.norm(baked.places[-1, baked.of("row")] - guide, axis=-1)
    assert away.max() < 6, away


@pytest.mark.parametrize("late", [False, True])
def test_a_behaviour_says_how_fast_somebody_walks(bake, late):
    """Also where others come in later: nobody's pace is made anew by that, and they have theirs from the beginning."""
    layout = {"throng": 1, "simulation": {"duration": 14}, "areas": [
        {"id": "start", "polygon": box(-1, -1, 2, 2)}, {"id": "end", "polygon": box(29, -1, 2, 2)}],
        "behaviours": [{"id": "strolls", "start": "go", "states": {"go": {"walk_to": "end", "pace": 0.6}}}],
        "formations": [{"id": "one", "type": "agents", "behaviour": "strolls", "people": {"speed": 1.4},
                        "agents": [{"position": [0, 5]}]}]}
    if late:
        layout["flows"] = [{"id": "more", "from": "start", "count": 2, "start": 2, "end": 4, "behaviour": "strolls",
                            "people": {"speed": 1.4}}]
    baked = bake(f"pace {late}", layout)
    speeds = numpy.linalg.norm(numpy.diff(baked.places, axis=0), axis=-1) * baked.fps
    for row in range(speeds.shape[1]):
        walks = numpy.flatnonzero(baked.doing[:, row] > 0)
        assert numpy.median(speeds[walks[0] + 48:walks[-1], row]) == pytest.approx(0.84, abs=0.02)


def test_who_flees_gets_away(bake):
    layout = conditions({"at": 2}, then="run")
    layout["behaviours"][0]["states"] = {
        "stand": {"stay": True, "until": [{"at": 2, "then": "run"}]},
        "run": {"flee": [3, 0], "beyond": 12, "then": "rest"}, "rest": {"stay": True, "for_good": True}}
    baked = bake("flee", layout)
    away = numpy.linalg.norm(baked.places[-1] - [3, 0], axis=-1)
    assert away.min() > 11.5 and away.max() < 16, away


def test_who_flees_from_somebody_keeps_away_from_where_it_goes(bake):
    """A given way goes right through them: whoever it comes near runs, and stays away."""
    layout = conditions({"at": 0.5})
    layout["behaviours"][0]["states"] = {
        "stand": {"stay": True, "until": [{"near": "bull", "within": 8, "then": "run"}]},
        "run": {"flee": "bull", "beyond": 6, "pace": 1.6}}
    layout["given"] = [{"id": "bull", "ways": [[[0, -4, -12], [20, 9, 12]]]}]
    baked = bake("bull", layout)
    bull, row = baked.places[:, baked.of("bull")], baked.places[:, baked.of("row")]
    away = numpy.linalg.norm(row - bull, axis=-1)
    assert numpy.nanmin(numpy.linalg.norm(row[0] - bull, axis=-1)) < 2.0, "it goes to where they stood"
    assert numpy.linalg.norm(bull[-1] - bull[0]) > 20 and away.min() > 3.0, away.min()


def test_who_flees_from_somebody_has_got_away_only_when_it_is_far_from_it(bake):
    layout = conditions({"at": 0.5})
    layout["behaviours"][0]["states"] = {
        "stand": {"stay": True, "until": [{"near": "bull", "within": 5, "then": "run"}]},
        "run": {"flee": "bull", "beyond": 7, "pace": 1.6, "then": "stand"}}
    layout["given"] = [{"id": "bull", "ways": [[[0, -4, -12], [20, 9, 12]]]}]
    baked = bake("bull and then", layout)
    away = numpy.linalg.norm(baked.places[:, baked.of("row")] - baked.places[:, baked.of("bull")], axis=-1)
    assert away.min() > 2.5, away.min()
    speeds = numpy.linalg.norm(numpy.diff(baked.places[:, baked.of("row")], axis=0), axis=-1) * baked.fps
    assert (speeds[-24:] < 0.1).any(axis=0).sum() >= 4, "and then they stand again"


def test_given_people_are_followed(bake):
    layout = conditions({"after": 100})
    layout["behaviours"] = [{"id": "waits", "start": "follow", "states": {
        "follow": {"follow": "guide", "distance": 2, "until": [{"after": 100, "then": "go"}]},
        "go": {"walk_to": "away"}}}]
    layout["given"] = [{"id": "guide", "ways": [[[0, 9, 0], [18, 9, 18]]]}]
    baked = bake("follow given", layout)
    away = numpy.linalg.norm(baked.places[-1, baked.of("row")] - [9, 18], axis=-1)
    assert away.max() < 6, away
