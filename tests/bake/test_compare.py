# SPDX-License-Identifier: Apache-2.0
"""`throng compare`: a bake beside trajectories whose figures are known, or worked out by NumPy and PedPy."""
import json
import math
import sqlite3
import warnings

import numpy
import pytest

import throng_io

EVERYWHERE = ["--area", -1000, -1000, 1000, 1000]


@pytest.fixture(scope="module")
def circle(bakes):
    return bakes("circle")


@pytest.fixture(scope="module")
def compare(throng, circle):
    def run(people, *arguments, bake=None):
        return json.loads(throng("compare", bake or circle, people, "--json", *arguments).stdout)

    return run


def write(path, rows, begin="# framerate: 24 fps\n# id frame x/m y/m\n", scale=1.0):
    path.write_text(begin + "".join(f"{person}\t{frame}\t{scale * x:.9g}\t{scale * y:.9g}\n"
                                    for person, frame, x, y in rows))
    return path


def walked(bake):
    """Rows of everybody until it arrives, as a file of trajectories has them."""
    opened = throng_io.Bake(bake)
    places = opened.world()
    there = opened.there()
    arrival = opened.people["arrival_frame"]
    return [(person, frame, *places[frame, person, :2]) for person in range(there.shape[1])
            for frame in numpy.flatnonzero(there[:, person]) if arrival[person] < 0 or frame <= arrival[person]]


def platoon(rate=25.0, speed=1.2, apart=1.4, people=12, seconds=20.0, sway=0.0):
    """One behind the other along x, each swaying aside once a second."""
    frames = numpy.arange(int(seconds * rate))
    return [(person, frame, speed * frame / rate - apart * person, sway * math.sin(2 * math.pi * frame / rate))
            for person in range(people) for frame in frames]


def seen(answer, figure, what="median"):
    return answer["figures"][figure]["trajectories"][what]


def test_a_bake_is_like_itself(compare, circle):
    answer = compare(circle)
    assert answer["bake"] == answer["trajectories"]
    for name, figure in answer["figures"].items():
        assert figure["bake"] == figure["trajectories"]
        assert figure["bake"]["samples"] > 100 or name == "wall"
        assert figure.get("wasserstein", 0.0) == figure.get("kolmogorov_smirnov", 0.0) == 0.0


def test_the_same_ways_read_from_any_file_are_alike(compare, circle, tmp_path):
    rows = walked(circle)
    bake = throng_io.Bake(circle)
    with sqlite3.connect(tmp_path / "people.sqlite") as database:
        database.execute("CREATE TABLE metadata (key TEXT, value TEXT)")
        database.execute("INSERT INTO metadata VALUES ('fps', ?)", (str(bake.fps),))
        database.execute("CREATE TABLE trajectory_data (frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL)")
        database.executemany("INSERT INTO trajectory_data VALUES (?, ?, ?, ?)",
                             [(int(frame), int(person), float(x), float(y)) for person, frame, x, y in rows])
    csv = tmp_path / "people.csv"
    csv.write_text("time,y,x,id\n" + "".join(f"{frame / bake.fps:.6f},{y:.9g},{x:.9g},{person}\n"
                                             for person, frame, x, y in rows))
    whole = compare(circle, *EVERYWHERE)
    for people in (write(tmp_path / "metres.txt", rows),
                   write(tmp_path / "centimetres.txt", rows, "# framerate: 24\n# id frame x/cm y/cm z/cm\n", 100.0),
                   csv, tmp_path / "people.sqlite"):
        answer = compare(people, *EVERYWHERE)
        assert answer["trajectories"]["people"] == answer["bake"]["people"]
        for name in ("speed", "acceleration", "turning", "sway", "density", "neighbour"):
            assert answer["figures"][name]["kolmogorov_smirnov"] < 0.004, (people.name, name)
            assert answer["figures"][name]["bake"] == whole["figures"][name]["bake"]


def test_jupedsims_own_database_is_read(compare, circle, tmp_path):
    throng_io.Bake(circle).to_jupedsim_sqlite(tmp_path / "people.sqlite")
    answer = compare(tmp_path / "people.sqlite", *EVERYWHERE)
    assert answer["trajectories"]["people"] == answer["bake"]["people"]
    # It has those who have arrived and stand there, too.
    assert answer["trajectories"]["seconds"] > answer["bake"]["seconds"]


def test_a_platoon_is_what_it_is(compare, tmp_path):
    answer = compare(write(tmp_path / "p.txt", platoon(), "# framerate: 25\n"), *EVERYWHERE, "--line", 3, -1, 3, 1)
    assert seen(answer, "speed") == pytest.approx(1.2, abs=0.002)
    assert seen(answer, "speed", "p90") == pytest.approx(1.2, abs=0.003)
    assert seen(answer, "acceleration", "p90") < 0.01
    assert seen(answer, "turning", "p90") < 0.2
    assert seen(answer, "sway", "p90") < 0.001
    assert seen(answer, "neighbour") == pytest.approx(1.4, abs=0.003)
    assert seen(answer, "time_gap") == pytest.approx(1.4 / 1.2, abs=0.006)
    assert answer["trajectories"]["flow"] == pytest.approx(1.2 / 1.4, rel=1e-3)
    # Of the truncated disc, strips of 0.3 m are cut off at both ends of those in the middle.
    segment = math.acos(0.7) - 0.7 * math.sqrt(1 - 0.7**2)
    assert seen(answer, "density") == pytest.approx(1 / (math.pi - 2 * segment), rel=0.02)


def test_who_sways_sways(compare, tmp_path):
    rows = platoon(rate=50.0, sway=0.04)
    answer = compare(write(tmp_path / "p.txt", rows, "# framerate: 50\n"), *EVERYWHERE)
    # Aside of the mean of thirteen looks over 1.2 s, of which most evens out.
    looks = numpy.arange(-6, 7) / 10
    gain = 1 - numpy.cos(2 * math.pi * looks).mean()
    assert seen(answer, "sway", "mean") == pytest.approx(0.04 * gain * 2 / math.pi, rel=0.05)
    assert answer["figures"]["sway"]["trajectories"]["p90"] == pytest.approx(0.04 * gain, rel=0.07)


def test_who_walks_in_a_circle_turns(compare, tmp_path):
    radius, speed = 2.0, 1.0
    rows = [(0, frame, radius * math.cos(speed / radius * frame / 25), radius * math.sin(speed / radius * frame / 25))
            for frame in range(500)]
    answer = compare(write(tmp_path / "p.txt", rows, "# framerate: 25\n"), *EVERYWHERE)
    assert seen(answer, "turning") == pytest.approx(math.degrees(speed / radius), rel=0.01)
    assert seen(answer, "acceleration") == pytest.approx(speed**2 / radius, rel=0.02)
    assert seen(answer, "density") == pytest.approx(1 / math.pi, rel=0.02)


def test_faster_people_are_apart_by_how_much_faster_they_are(compare, circle, tmp_path):
    answer = compare(write(tmp_path / "p.txt", walked(circle), "# framerate: 28.8\n"), *EVERYWHERE)
    speed = answer["figures"]["speed"]
    assert speed["trajectories"]["mean"] == pytest.approx(1.2 * speed["bake"]["mean"], rel=0.01)
    assert speed["wasserstein"] == pytest.approx(0.2 * speed["bake"]["mean"], rel=0.05)
    assert speed["kolmogorov_smirnov"] > 0.2
    assert answer["figures"]["neighbour"]["kolmogorov_smirnov"] < 0.1


def test_distances_are_those_of_numpy(compare, tmp_path):
    """Two crowds of people who each keep a speed of their own: distributions of as many values."""
    engine = numpy.random.default_rng(5)
    files, speeds = [], []
    for name in ("a", "b"):
        own = engine.uniform(0.4, 1.4 if name == "a" else 1.9, 40)
        rows = [(person, frame, own[person] * frame / 10, 10.0 * person) for person in range(40) for frame in range(60)]
        files.append(write(tmp_path / f"{name}.txt", rows, "# framerate: 10\n"))
        speeds.append(numpy.sort(own))
    a, b = (compare(file, *EVERYWHERE)["figures"]["speed"]["trajectories"] for file in files)
    assert a["mean"] == pytest.approx(speeds[0].mean(), abs=0.003)
    assert b["p90"] == pytest.approx(numpy.quantile(speeds[1], 0.9), abs=0.04)
    assert numpy.abs(speeds[0] - speeds[1]).mean() == pytest.approx(b["mean"] - a["mean"], abs=0.01)


def test_density_is_that_of_pedpy(compare, circle):
    pedpy = pytest.importorskip("pedpy")
    people, ground = throng_io.Bake(circle).to_pedpy(every=24)
    bake = throng_io.Bake(circle)
    cut = pedpy.Cutoff(radius=1.0, quad_segments=16)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        wide = pedpy.WalkableArea(ground.polygon.buffer(5))
        cells = pedpy.compute_individual_voronoi_polygons(traj_data=people, walkable_area=wide, cut_off=cut)
    arrival = dict(enumerate(bake.people["arrival_frame"]))
    row_of = {person: row for row, person in enumerate(sorted(people.data.id.unique()))}
    walking = [arrival[row_of[person]] < 0 or frame * (24 if people.data.frame.max() < bake.frames / 12 else 1)
               <= arrival[row_of[person]] for person, frame in zip(cells.id, cells.frame)]
    answer = compare(circle, *EVERYWHERE)
    assert seen(answer, "density", "mean") == pytest.approx(cells.density[walking].mean(), rel=0.03)


def test_trajectories_are_put_where_the_bake_is(compare, circle, tmp_path):
    turned = [(person, frame, y - 3.0, 7.0 - x) for person, frame, x, y in walked(circle)]
    people = write(tmp_path / "p.txt", turned)
    answer = compare(people, "--turn", 90, "--move", 7, 3, *EVERYWHERE)
    for figure in answer["figures"].values():
        assert figure.get("kolmogorov_smirnov", 0.0) < 0.004


def test_people_outside_the_area_are_nobodys_sample(compare, tmp_path):
    rows = platoon() + [(person + 100, frame, x, y + 300.0) for person, frame, x, y in platoon(speed=0.5)]
    people = write(tmp_path / "p.txt", rows, "# framerate: 25\n")
    assert seen(compare(people, "--area", -30, -20, 40, 20), "speed", "p10") == pytest.approx(1.2, abs=0.003)
    assert seen(compare(people, *EVERYWHERE), "speed", "p10") == pytest.approx(0.5, abs=0.003)


def test_somebody_who_was_out_of_sight_did_not_jump(compare, tmp_path):
    rows = [row for row in platoon(people=1) if not 100 < row[1] < 300]
    answer = compare(write(tmp_path / "p.txt", rows, "# framerate: 25\n"), *EVERYWHERE)
    assert answer["trajectories"]["people"] == 1
    assert seen(answer, "speed", "p90") == pytest.approx(1.2, abs=0.003)
    assert seen(answer, "acceleration", "p90") < 0.01


def test_plots_are_drawn(throng, circle, tmp_path):
    people = write(tmp_path / "p.txt", platoon(), "# framerate: 25\n")
    said = throng("compare", circle, people, "--plots", tmp_path / "plots", "--line", 3, -1, 3, 1, *EVERYWHERE).stdout
    assert "flow, persons/s" in said and "Nearest neighbour, m" in said
    drawn = {path.stem for path in (tmp_path / "plots").glob("*.png")}
    assert drawn == {"speed", "acceleration", "turning", "sway", "density", "neighbour", "wall", "time_gap",
                     "speed_by_density", "passed"}


WRONG = {
    "no rate": ("1 0 0 0\n1 1 0 0\n", "how many frames a second has"),
    "no frames in a second": ("# framerate: 0\n1 0 0 0\n1 1 1 1\n", "0 frames a second"),
    "too few": ("# framerate: 25\n1 0 0 0\n1 1 0\n", "3:6: expected 4 numbers"),
    "a word": ("# framerate: 25\n1 0 0 0\n1 1 here 0\n", "3:5: expected x"),
    "nowhere": ("# framerate: 25\n1 0 nan 0\n", "2:5: expected x"),
    "too far": ("# framerate: 25\n1 0 0 1e300\n", "2:7: expected y"),
    "half a frame": ("# framerate: 25\n1 0.5 0 0\n", "2:3: expected a frame, a whole number"),
    "two places": ("# framerate: 25\n1 0 0 0\n2 0 0 0\n1 0 1 1\n", "4: person 1 is in two places in frame 0"),
    "other columns": ("name,where\nme,here\n", "1:1: expected a person, a frame, x and y"),
    "nobody": ("# framerate: 25\n", "has no people"),
    "elsewhere": ("# framerate: 25\n" + "".join(f"1 {i} {9000 + 0.1 * i} 0\n" for i in range(99)), "--move"),
    "no database": ("SQLite format 3\0" + "x" * 4000, "no database of trajectories"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_with_a_file_is_said(confined, circle, tmp_path, name):
    text, complaint = WRONG[name]
    (tmp_path / "p.txt").write_text(text)
    failed = confined("compare", circle, tmp_path / "p.txt", "--plots", tmp_path / "plots", expect=None)
    assert failed.returncode == 3 and complaint in failed.stderr and failed.stderr.count("throng: ") == 1
    assert not (tmp_path / "plots").exists()


def test_other_databases_are_refused(confined, circle, tmp_path):
    with sqlite3.connect(tmp_path / "p.sqlite") as database:
        database.execute("CREATE TABLE metadata (key TEXT, value TEXT)")
        database.execute("INSERT INTO metadata VALUES ('fps', '10')")
        database.execute("CREATE TABLE trajectory_data (frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL)")
        database.execute("INSERT INTO trajectory_data VALUES (9223372036854775807, 1, 0.0, 0.0)")
    assert "frame 9223372036854775807" in confined("compare", circle, tmp_path / "p.sqlite", expect=3).stderr
    with sqlite3.connect(tmp_path / "q.sqlite") as database:
        database.execute("CREATE TABLE anything (value TEXT)")
    assert "no database of trajectories" in confined("compare", circle, tmp_path / "q.sqlite", expect=3).stderr
