# SPDX-License-Identifier: Apache-2.0
"""Scenes of other crowd simulators: what is in them arrives in a layout that is valid and bakes, the report tells the
rest, and hostile files end in one clear sentence."""
import json
import sqlite3

import pytest
import shapely

import throng_io
from throng_io import cli
from throng_io.importers.formats import read_scene

pytest.importorskip("lxml", reason="lxml is not installed")

UMANS = """<Simulation delta_time="0.1" end_time="30"><World type="Infinite"><Obstacles file="walls.xml"/></World>
<Policies file="policies.xml"/><Agents>
<Agent rad="0.2" pref_speed="1.4" remove_at_goal="true" start_time="2"><pos x="-5" y="0"/><goal x="-3" y="4"/>
<goal x="6" y="0.5"/></Agent>
<Agent><pos x="5" y="0"/><goal x="-5" y="0"/></Agent></Agents></Simulation>"""
UMANS_WALLS = """<Obstacles><Obstacle><Point x="-1" y="-1"/><Point x="1" y="-1"/><Point x="1" y="1"/>
<Point x="-1" y="1"/>
</Obstacle></Obstacles>"""

STEERSUITE = """<SteerBenchTestCase xmlns="http://www.magix.ucla.edu/steerbench"><header><version>1.0</version>
<worldBounds><xmin>-9</xmin><xmax>9</xmax><ymin>0</ymin><ymax>0</ymax><zmin>-9</zmin><zmax>9</zmax></worldBounds>
</header>
<obstacle><xmin>-1</xmin><xmax>1</xmax><ymin>0</ymin><ymax>2</ymax><zmin>2</zmin><zmax>5</zmax></obstacle>
<circleObstacle><radius>0.5</radius><height>1</height><position><x>3</x><y>0</y><z>-4</z></position></circleObstacle>
<agent><initialConditions><radius>0.3</radius><position><x>-4</x><y>0</y><z>1</z></position>
<direction><x>0</x><y>0</y><z>-1</z></direction><speed>0</speed></initialConditions><goalSequence>
<seekStaticTarget><targetLocation><x>0</x><y>0</y><z>0</z></targetLocation><desiredSpeed>1.3</desiredSpeed>
</seekStaticTarget>
<seekStaticTarget><targetLocation><x>5</x><y>0</y><z>1</z></targetLocation><desiredSpeed>1.2</desiredSpeed>
</seekStaticTarget>
</goalSequence></agent>
<agentRegion><numAgents>5</numAgents><regionBounds><xmin>-8</xmin><xmax>-5</xmax><ymin>0</ymin><ymax>0</ymax>
<zmin>-8</zmin>
<zmax>-5</zmax></regionBounds><initialConditions><direction><random>true</random></direction><radius>0.3</radius>
<speed>0</speed></initialConditions><goalSequence><seekStaticTarget><targetLocation><random>true</random>
</targetLocation>
<desiredSpeed>1.3</desiredSpeed></seekStaticTarget></goalSequence></agentRegion>
<agentEmitter><name>E</name></agentEmitter></SteerBenchTestCase>"""

MENGE = """<Project scene="s.xml" behavior="b.xml" view="v.xml" duration="40" model="orca"/>"""
MENGE_SCENE = """<Experiment version="2.0"><SpatialQuery type="kd-tree"/><Helbing agent_scale="2000"/>
<AgentProfile name="slow"><Common r="0.25" pref_speed="1"/></AgentProfile>
<AgentProfile name="fast" inherits="slow"><Common><Property name="pref_speed" dist="u" min="1.5" max="1.6"/></Common>
</AgentProfile>
<AgentGroup><ProfileSelector type="const" name="fast"/><StateSelector type="const" name="Walk"/>
<Generator type="rect_grid" anchor_x="-6" anchor_y="-2" offset_x="1" offset_y="1" count_x="2" count_y="3"/></AgentGroup>
<AgentGroup><ProfileSelector type="const" name="slow"/><StateSelector type="const" name="Cross"/>
<Generator type="explicit"><Agent p_x="4" p_y="3"/></Generator></AgentGroup>
<ObstacleSet type="explicit" class="1"><Obstacle closed="1"><Vertex p_x="-1" p_y="-1"/><Vertex p_x="1" p_y="-1"/>
<Vertex p_x="1" p_y="1"/><Vertex p_x="-1" p_y="1"/></Obstacle><Obstacle closed="0"><Vertex p_x="-9" p_y="6"/>
<Vertex p_x="9" p_y="6"/></Obstacle></ObstacleSet><ObstacleSet type="nav_mesh" file_name="n.nav"/></Experiment>"""
MENGE_BEHAVIOUR = """<BFSM><GoalSet id="0"><Goal type="AABB" id="0" min_x="4" min_y="-4" max_x="6" max_y="-2"/>
<Goal type="point" id="1" x="-3" y="4"/></GoalSet>
<State name="Walk"><GoalSelector type="explicit" goal_set="0" goal="1"/></State>
<State name="On"><GoalSelector type="explicit" goal_set="0" goal="0"/></State>
<State name="Stop" final="1"><GoalSelector type="identity"/></State>
<State name="Cross"><GoalSelector type="mirror" mirror_x="1" mirror_y="1"/></State>
<Transition from="Walk" to="On"><Condition type="goal_reached" distance="0.25"/></Transition>
<Transition from="On,Cross" to="Stop"><Condition type="goal_reached" distance="0.25"/></Transition></BFSM>"""


def box(x, y, width, height):
    return {"x": x, "y": y, "width": width, "height": height, "type": "RECTANGLE"}


VADERE = {"name": "corner", "release": "1.15", "scenario": {
    "mainModel": "org.vadere.simulator.models.osm.OptimalStepsModel", "attributesSimulation": {"finishTime": 60.0},
    "topography": {
        "attributes": {"bounds": {"x": 0, "y": 0, "width": 14, "height": 12}, "boundingBoxWidth": 0.5, "bounded": True},
        "obstacles": [{"shape": box(5, 4, 1, 4), "id": 1},
                      {"shape": {"type": "POLYGON", "points": [{"x": 8, "y": 8}, {"x": 9, "y": 8}, {"x": 9, "y": 9}]},
                       "id": 2}],
        "targets": [{"id": 1, "absorbing": True, "shape": box(11, 5, 2, 2), "waitingTime": 0.0},
                    {"id": 2, "absorbing": False, "shape": box(5, 1, 2, 2), "waitingTime": 2.0}],
        "measurementAreas": [{"id": 9, "shape": box(1, 1, 2, 2)}],
        "sources": [{"id": 4, "shape": box(1, 4, 2, 4), "spawnNumber": 2, "maxSpawnNumberTotal": 5, "startTime": 0.0,
                     "endTime": 6.0, "distributionParameters": [2.0], "targetIds": [2, 1],
                     "interSpawnTimeDistribution": "org.vadere.state.scenario.ConstantDistribution"},
                    {"id": 5, "shape": box(1, 9, 2, 2), "targetIds": [1], "spawner": {
                        "eventElementCount": 1, "constraintsElementsMax": -1, "constraintsTimeStart": 1.0,
                        "constraintsTimeEnd": 1.0, "distribution": {"type": "x.AttributesConstantDistribution",
                                                                    "updateFrequency": 1.0}}},
                    {"id": 6, "shape": box(1, 1, 1, 1), "targetIds": []}],
        "dynamicElements": [{"type": "PEDESTRIAN", "position": {"x": 3.0, "y": 2.0}, "targetIds": [2, 1],
                             "freeFlowSpeed": 1.4, "attributes": {"radius": 0.2}}],
        "attributesPedestrian": {"radius": 0.2, "speedDistributionMean": 1.3}}}}

ROOM = "POLYGON ((0 0, 12 0, 12 8, 0 8, 0 0), (5 3, 7 3, 7 5, 5 5, 5 3))"


def write_jupedsim(path, wkt=ROOM, x=1.0, fps="5"):
    with sqlite3.connect(path) as database:
        database.executescript("CREATE TABLE trajectory_data (frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL, "
                               "ori_x REAL, ori_y REAL); CREATE TABLE metadata (key TEXT, value TEXT);"
                               "CREATE TABLE geometry (hash INTEGER, wkt TEXT);")
        database.execute("INSERT INTO geometry VALUES (1, ?)", (wkt,))
        database.executemany("INSERT INTO metadata VALUES (?, ?)", [("version", "2"), ("fps", fps)])
        database.executemany("INSERT INTO trajectory_data VALUES (?, ?, ?, ?, 1, 0)",
                             [(frame, person, x + 0.25 * (frame - 10 * person), 1.0 + person) for person in range(2)
                              for frame in range(10 * person, 10 * person + 36)])


def write_scene(name, folder):
    """The file of each kind of scene."""
    texts = {"umans": {"scene.xml": UMANS, "walls.xml": UMANS_WALLS}, "steersuite": {"scene.xml": STEERSUITE},
             "menge": {"scene.xml": MENGE, "s.xml": MENGE_SCENE, "b.xml": MENGE_BEHAVIOUR},
             "vadere": {"scene.scenario": json.dumps(VADERE)}, "wkt": {"scene.wkt": ROOM}}
    if name == "jupedsim":
        write_jupedsim(folder / "scene.sqlite")
        return folder / "scene.sqlite"
    for file, text in texts[name].items():
        (folder / file).write_text(text)
    return folder / next(iter(texts[name]))


@pytest.mark.parametrize("name, people", [("umans", 2), ("steersuite", 6), ("menge", 7), ("vadere", 7),
                                          ("jupedsim", 2)])
def test_scenes_bake_and_everybody_arrives(name, people, throng, tmp_path, capsys):
    source = write_scene(name, tmp_path)
    assert cli.main(["import", str(source), "-o", str(tmp_path / "layout.json"), "--report"]) == 0
    assert f"{people} people" in capsys.readouterr().out
    assert throng_io.check(tmp_path / "layout.json", throng.binary) == []
    bake = throng_io.bake(tmp_path / "layout.json", tmp_path / "bake", program=throng.binary)
    assert bake.agents == people and bake.account["arrived"] == people


def test_umans_says_what_it_says(tmp_path):
    found = read_scene(write_scene("umans", tmp_path))
    leaving, staying = found.layout["formations"]
    assert leaving["agents"] == [{"position": [-5, 0], "via": [{"point": [-3, 4]}], "goal": [6, 0.5], "start": 2,
                                  "speed": 1.4, "radius": 0.2}]
    assert (leaving["arrival"], staying["arrival"]) == ("leave", "stay")
    assert staying["agents"][0]["radius"] == 0.24 and found.layout["simulation"]["duration"] == 30
    assert found.layout["walls"][0]["closed"] and len(found.layout["walls"][0]["points"]) == 4
    assert ("policies", "people move by Throng's own rules") in found.report.left


def test_steersuite_is_turned_to_z_up(tmp_path):
    found = read_scene(write_scene("steersuite", tmp_path))
    wall = found.layout["walls"][0]
    assert sorted(map(tuple, wall["points"])) == [(-1, -5), (-1, -2), (1, -5), (1, -2)] and wall["height"] == 2
    person = found.layout["formations"][0]["agents"][0]
    assert person == {"position": [-4, -1], "via": [{"point": [0, 0]}], "goal": [5, -1], "speed": 1.2, "radius": 0.3,
                      "heading": 90}
    assert found.report.left["<agentEmitter>", "has no counterpart"] == 1
    again = read_scene(write_scene("steersuite", tmp_path))
    assert again.layout == found.layout


def test_menge_follows_profiles_and_states(tmp_path):
    found = read_scene(write_scene("menge", tmp_path))
    grid, cross = found.layout["formations"]
    assert [person["position"] for person in grid["agents"]] == [[-6 + x, -2 + y] for x in range(2) for y in range(3)]
    for person in grid["agents"]:
        assert 4 <= person["goal"][0] <= 6 and -4 <= person["goal"][1] <= -2
        assert 1.5 <= person["speed"] <= 1.6 and person["radius"] == 0.25
        assert person["via"] == [{"point": [-3, 4]}]
    assert cross["agents"] == [{"position": [4, 3], "goal": [-4, -3], "speed": 1, "radius": 0.25}]
    assert [wall.get("closed", False) for wall in found.layout["walls"]] == [True, False]
    assert found.report.left["obstacles of the type nav_mesh", "are in a file of their own"] == 1


MENGE_DRAWN = """<BFSM><GoalSet id="0"><Goal type="point" id="0" x="5" y="5"/><Goal type="point" id="1" x="-5" y="5"/>
</GoalSet><GoalSet id="1"><Goal type="point" id="0" x="9" y="0" weight="3"/><Goal type="point" id="1" x="-9" y="0"/>
<Goal type="point" id="2" x="0" y="9"/><Goal type="point" id="3" x="0" y="-9"/></GoalSet>
<State name="Walk"><GoalSelector type="explicit" goal_set="0" goal="0"/></State>
<State name="Cross"><GoalSelector type="explicit" goal_set="0" goal="0"/></State>
<State name="Look"><GoalSelector type="identity"/></State>
<State name="Back"><GoalSelector type="explicit" goal_set="0" goal="1"/></State>
<State name="Out"><GoalSelector type="weighted" goal_set="1"/></State>
<Transition from="Walk,Cross"><Condition type="goal_reached" distance="1"/>
<Target type="prob"><State name="Look" weight="2"/><State name="Back"/></Target></Transition>
<Transition from="Look" to="Out"><Condition type="timer" dist="u" min="2" max="4"/></Transition>
<Transition from="Back" to="Out"><Condition type="space"/></Transition>
<Transition from="Out" to="Walk"><Condition type="timer" dist="c" value="3"/></Transition></BFSM>"""


def test_menge_draws_for_everybody_and_keeps_timers_of_who_stands(tmp_path):
    (tmp_path / "project.xml").write_text(MENGE)
    (tmp_path / "s.xml").write_text(MENGE_SCENE.replace('count_x="2" count_y="3"', 'count_x="10" count_y="10"'))
    (tmp_path / "b.xml").write_text(MENGE_DRAWN)
    found = read_scene(tmp_path / "project.xml")
    people = found.layout["formations"][0]["agents"]
    stood = [person["via"] for person in people if "wait" in person["via"][0]]
    back = [person["via"] for person in people if "wait" not in person["via"][0]]
    assert 50 < len(stood) < 85 and len(stood) + len(back) == 100  # two thirds
    assert all(2 <= via[0]["wait"] <= 4 and via[0]["point"] == [5, 5] and len(via) == 1 for via in stood)
    assert all([stop["point"] for stop in via] == [[5, 5], [-5, 5]] for via in back)
    assert len({tuple(person["goal"]) for person in people}) == 4
    assert 35 < sum(person["goal"] == [9, 0] for person in people) < 65  # weighs as much as all others
    told = "\n".join(" ".join(key) for key in found.report.changed)
    for words in ("by space", "whose way a timer ends", "in a circle: once"):
        assert words in told


def test_vadere_brings_sources_targets_and_single_people(tmp_path):
    found = read_scene(write_scene("vadere", tmp_path))
    first, second = found.layout["flows"]
    assert (first["from"], first["to"], first["count"], first["end"]) == ("source 4", "target 1", 5, 6)
    assert first["via"] == [{"at": "target 2", "wait": 2.0}] and first["people"]["speed"]["normal"] == [1.3, 0.26]
    assert (second["count"], second["start"], second["arrival"]) == (1, 1, "leave")
    single = found.layout["formations"][0]["agents"][0]
    assert single["via"] == [{"point": [6, 2], "wait": 2}] and single["goal"] == "target 1"
    border = next(wall for wall in found.layout["walls"] if wall.get("id") == "border")
    assert min(border["points"]) == [0.4, 0.4] and border["thickness"] == 0.2
    assert found.report.left["sources", "people without a target"] == 1
    assert found.report.left["measurementAreas", "layouts measure across a line only"] == 1


def test_jupedsim_brings_ground_and_people(tmp_path):
    found = read_scene(write_scene("jupedsim", tmp_path))
    walls = shapely.union_all([shapely.Polygon(wall["points"]) for wall in found.layout["walls"]])
    assert walls.symmetric_difference(shapely.box(-0.2, -0.2, 12.2, 8.2).difference(shapely.from_wkt(ROOM))).area < 1e-6
    now, later = found.layout["formations"][0]["agents"]
    assert now == {"position": [1, 1], "goal": [9.75, 1], "speed": 1.25} and later["start"] == 2
    assert read_scene(write_scene("wkt", tmp_path)).layout["walls"] == found.layout["walls"]


def test_thin_walls_between_rooms_stay(tmp_path):
    (tmp_path / "rooms.wkt").write_text("POLYGON ((0 0, 3 0, 3 2, 3.1 2, 3.1 0, 6 0, 6 4, 0 4, 0 0))")
    walls = [shapely.Polygon(wall["points"]) for wall in read_scene(tmp_path / "rooms.wkt").layout["walls"]]
    assert shapely.union_all(walls).covers(shapely.box(3, 0, 3.1, 2))


def bomb(root):
    levels = "".join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 10))
    return f'<!DOCTYPE {root} [<!ENTITY e0 "ha">{levels}]><{root}>&e9;</{root}>'


def deep(levels):
    return "[" * levels + "]" * levels


HOSTILE = {
    "bomb.xml": (bomb("Simulation"), "entities of its own"),
    "outside.xml": ('<!DOCTYPE Simulation [<!ENTITY x SYSTEM "file:///etc/passwd">]><Simulation>&x;</Simulation>',
                    "entities of its own"),
    "cut.xml": (UMANS[:200], "no XML"),
    "other.xml": ("<html/>", "its root is <html>"),
    "deep.xml": ("<Simulation>" + "<a>" * 5000, "no XML"),
    "nan.xml": (UMANS.replace('x="-5"', 'x="nan"'), "pos x: expected a number, found 'nan'"),
    "far.xml": (UMANS.replace('x="-5"', 'x="1e300"'), "expected coordinates from"),
    "circle.xml": ('<Simulation><Agents file="circle2.xml"/></Simulation>', "there is no such file"),
    "many.xml": (STEERSUITE.replace("<numAgents>5<", "<numAgents>1e30<"), "expected 0 to 100000"),
    "deep.json": (deep(100_000), "nested too deeply"),
    "nan.scenario": (json.dumps(VADERE).replace('"x": 11', '"x": NaN'), "NaN is no number"),
    "text.scenario": (json.dumps(VADERE).replace('"x": 11', '"x": "far"'), "x: expected a number, found 'far'"),
    "form.scenario": ('{"scenario": {"topography": {"attributes": 3}}}', "not the form of a Vadere scenario"),
    "none.scenario": ('{"scenario": {}}', "expected a scenario with a topography"),
    "cut.scenario": ('{"scenario": ', "no JSON"),
    "bad.wkt": ("POLYGON ((0 0, 1", "no WKT"),
    "nan.wkt": ("POLYGON ((0 0, nan 0, 1 1, 0 0))", "finite coordinates"),
    "point.wkt": ("POINT (1 1)", "nothing that a layout can hold"),
    "bad.sqlite": ("SQLite format 3", "expected an SQLite database"),
    "what.doc": ("", "files that end in .doc are not known"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files_end_in_one_sentence(name, tmp_path, capsys):
    text, told = HOSTILE[name]
    (tmp_path / name).write_text(text)
    (tmp_path / "walls.xml").write_text(UMANS_WALLS)
    assert cli.main(["import", str(tmp_path / name), "-o", str(tmp_path / "layout.json")]) == 3
    errors = capsys.readouterr().err
    assert told in errors and name.partition(".")[0] in errors and "Traceback" not in errors
    assert not (tmp_path / "layout.json").exists()


def test_agents_that_name_themselves_end(tmp_path):
    (tmp_path / "a.xml").write_text('<Simulation><Agents file="b.xml"/></Simulation>')
    (tmp_path / "b.xml").write_text('<Agents file="b.xml"/>')
    with pytest.raises(throng_io.ImportFailed, match="name each other without an end"):
        read_scene(tmp_path / "a.xml")


def test_profiles_in_a_circle_end(tmp_path):
    source = write_scene("menge", tmp_path)
    (tmp_path / "s.xml").write_text(MENGE_SCENE.replace('<AgentProfile name="slow">',
                                                        '<AgentProfile name="slow" inherits="slow">')
                                    .replace('r="0.25"', ""))
    with pytest.raises(throng_io.ImportFailed, match="in a circle"):
        read_scene(source)


def test_outlines_that_cross_themselves_are_mended(throng, tmp_path):
    (tmp_path / "bow.wkt").write_text("POLYGON ((0 0, 10 10, 10 0, 0 10, 0 0))")
    found = read_scene(tmp_path / "bow.wkt")
    assert found.report.changed["walkable areas", "crossed themselves, and were mended"] == 1
    assert [each for each in throng_io.check(found.layout, throng.binary) if each.severity == "error"] == []


def test_trajectories_without_sense_are_told(tmp_path):
    for number, keys in enumerate([{"fps": "0"}, {"fps": "often"}, {"wkt": "POLYGON ("}, {"x": float("inf")}]):
        write_jupedsim(tmp_path / f"{number}.sqlite", **keys)
        with pytest.raises(throng_io.ImportFailed):
            read_scene(tmp_path / f"{number}.sqlite")
