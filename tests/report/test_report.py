# SPDX-License-Identifier: Apache-2.0
"""Report pages in a real, headless Chromium."""
import json
import pathlib
import re
import time

import numpy
import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent

# Two head-on streams in a corridor, one person shut in, somebody who never finds room.
LAYOUT = {
    "throng": 1,
    "name": "two <streams> & \"quotes\" @TITLE@",
    "simulation": {"duration": 20, "seed": 4},
    "areas": [{"id": "west", "polygon": [[0, 0], [2, 0], [2, 4], [0, 4]]},
              {"id": "east", "polygon": [[22, 0], [24, 0], [24, 4], [22, 4]]}],
    "walls": [{"id": "south", "points": [[-1, -0.2], [25, -0.2]]}, {"id": "north", "points": [[-1, 4.2], [25, 4.2]]},
              {"id": "gate", "points": [[12, -0.2], [12, 4.2]]}],
    "flows": [{"id": "forth", "from": "west", "to": "east", "rate": 3},
              {"id": "back", "from": "east", "to": "west", "rate": 3}],
    "events": [{"at": 3600, "open": "gate"}],
    "expect": {"arrived": {"min": 0.99}},
}


@pytest.fixture
def visit(browser):
    """Opens a page that may ask for nothing but itself; script errors fail the test."""
    pages, problems = [], []

    def open_page(path):
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        pages.append(page)
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.on("console", lambda message: problems.append(message.text) if message.type == "error" else None)
        page.on("request", lambda request: problems.append(request.url)
                if not request.url.startswith(("file:", "blob:", "data:")) else None)
        page.goto(path.as_uri())
        page.wait_for_selector("body[data-ready=yes]", timeout=120000)
        return page

    yield open_page
    assert problems == []
    for page in pages:
        page.close()


@pytest.fixture(scope="module")
def bake(throng, once):
    def make(folder):
        (folder / "layout.json").write_text(json.dumps(LAYOUT))
        throng("bake", folder / "layout.json", "-o", folder / "bake", "-q", "--no-gltf")
        throng("report", folder / "bake", "-o", folder / "bake.html")

    return once("report-bake", make)


def wait_until(page, condition):
    """As Playwright's wait_for_function, which evaluates text within the page: its policy forbids that."""
    end = time.monotonic() + 120
    while not page.evaluate(condition):
        assert time.monotonic() < end, condition
        page.wait_for_timeout(30)


def clock(page):
    return float(re.match(r"([\d.]+) s", page.inner_text("#clock")).group(1))


@pytest.mark.quick
def test_the_page_says_who_and_what(visit, bake):
    page = visit(bake / "bake.html")
    assert page.inner_text("h1") == LAYOUT["name"] == page.title()
    agents = len((bake / "bake" / "agents.csv").read_text().splitlines()) - 1
    account = page.inner_text("#account")
    assert re.search(rf"people\s+{agents}\b", account)
    assert "arrived is" in page.inner_text("#missed")
    assert page.locator("#plots svg").count() >= 3
    assert "still walking" in account


def test_places_in_the_page_are_those_of_the_streams_within_the_stated_error(visit, bake):
    page = visit(bake / "bake.html")
    positions = numpy.load(bake / "bake" / "streams" / "pos.npy")
    states = numpy.load(bake / "bake" / "streams" / "state.npy")
    said = page.evaluate("data.ways.largest_error")
    assert 0 < said < 0.25
    assert f"{100 * said:.1f} cm at most" in page.inner_text("#error")
    worst = 0.0
    for frame in [0, 1, 2, 47, 100, 101, 203, 286, 287]:
        got = numpy.array(page.evaluate(f"""(() => {{ const {{m, share}} = crowd.momentAt({frame} / data.fps);
            return Array.from({{length: count}}, (_, row) => {{
                const p = crowd.placeOf(row, m, share);
                return [p.x, p.y]; }}); }})()"""))
        there = states[frame, :, 0] > 0.5
        if there.any():
            worst = max(worst, numpy.abs(got[there] - positions[frame, there, :2]).max())
        asked = f"Array.from({{length: count}}, (_, row) => crowd.isThere(row, {frame}))"
        assert page.evaluate(asked) == there.tolist()
    assert worst <= said + 1e-4


def test_scrubbing_playing_and_the_keyboard(visit, bake):
    page = visit(bake / "bake.html")
    picture = lambda: page.evaluate("document.getElementById('people').toDataURL()")
    at_start = picture()
    page.fill("#scrub", "6")
    wait_until(page, "document.getElementById('clock').textContent.startsWith('6.00')")
    assert picture() != at_start
    page.focus("#stage")
    page.keyboard.press("ArrowRight")
    wait_until(page, "document.getElementById('clock').textContent.includes('frame 146')")
    page.keyboard.press("Shift+ArrowLeft")
    wait_until(page, "document.getElementById('clock').textContent.includes('frame 122')")
    page.keyboard.press("Home")
    wait_until(page, "document.getElementById('clock').textContent.startsWith('0.00')")
    page.keyboard.press("Space")
    page.wait_for_timeout(1000)
    assert page.inner_text("#play") == "Pause"
    page.keyboard.press("Space")
    assert 0.5 < clock(page) < 2.0
    scale = page.evaluate("view.scale")
    page.keyboard.press("+")
    assert page.evaluate("view.scale") > scale
    page.keyboard.press("0")
    assert page.evaluate("view.scale") == pytest.approx(scale)
    page.keyboard.press("End")
    wait_until(page, "document.getElementById('clock').textContent.includes('frame 480')")
    # Everything can be reached with the Tab key.
    page.focus("#play")
    reached = set()
    for _ in range(12):
        page.keyboard.press("Tab")
        reached.add(page.evaluate("document.activeElement.id"))
    assert {"scrub", "rate", "colour", "density", "trails", "fit", "stage"} <= reached


INK = """const ink = canvas => {  // pixels that are drawn on
    const d = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    let n = 0;
    for (let i = 3; i < d.length; i += 4) n += d[i] > 0;
    return n; };"""


def test_densities_colours_and_closed_gates_are_drawn(visit, bake):
    page = visit(bake / "bake.html")
    page.evaluate("seek(8)")
    ink = lambda name: page.evaluate(f"(() => {{ draw(); {INK} return ink(document.getElementById('{name}')); }})()")
    assert ink("heat") == 0
    for kind in ("now", "mean", "most"):
        page.select_option("#density", kind)
        assert ink("heat") > 1000, kind
    before = page.evaluate("document.getElementById('people').toDataURL()")
    page.select_option("#colour", "speed")
    page.evaluate("draw()")
    assert page.evaluate("document.getElementById('people').toDataURL()") != before
    with_gate = ink("ground")
    page.evaluate("data.geometry.walls.find(wall => wall.id === 'gate').toggles = [1]")
    assert ink("ground") < with_gate


def test_whoever_is_stuck_is_linked_to_the_moment(throng, visit, bake):
    page = visit(bake / "bake.html")
    stuck = page.evaluate("data.stuck")
    assert stuck, "people press before the closed gate"
    assert len(stuck) == json.loads(throng("measure", bake / "bake", "--json", expect=None).stdout)["stuck"]
    positions = numpy.load(bake / "bake" / "streams" / "pos.npy")
    for each in stuck:
        moved = numpy.linalg.norm(positions[-1, each["agent"], :2] - positions[each["frame"]:, each["agent"], :2],
                                  axis=1)
        assert len(moved) > 5 * 24 and moved[:-5 * 24:6].max() < 0.5
    button = page.locator("#moments button").first
    button.click()
    page.wait_for_timeout(100)
    chosen = int(button.inner_text().split(" ")[0])
    assert page.evaluate("state.chosen") == chosen
    frame = next(each["frame"] for each in stuck if each["agent"] == chosen)
    assert f"frame {frame + 1} " in page.inner_text("#clock")


def test_overlaps_are_those_of_the_bake(throng, visit, tmp_path):
    # One round of contact is not enough for a hundred people who all want to the same square metre.
    layout = {"throng": 1, "name": "pairs", "simulation": {"duration": 2, "contact_iterations": 1},
              "formations": [{"id": "people", "type": "grid", "origin": [0, 0], "rows": 12, "columns": 12,
                              "spacing": 0.46, "people": {"radius": 0.22},
                              "goal": {"anywhere": [[0, 0], [1, 1]]}}]}
    (tmp_path / "layout.json").write_text(json.dumps(layout))
    throng("bake", tmp_path / "layout.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    throng("report", tmp_path / "bake", "-o", tmp_path / "page.html")
    page = visit(tmp_path / "page.html")
    positions = numpy.load(tmp_path / "bake" / "streams" / "pos.npy")
    found = page.evaluate("data.overlaps")
    assert found
    for each in found:
        gap = numpy.linalg.norm(positions[each["frame"], each["a"], :2] - positions[each["frame"], each["b"], :2])
        assert 100 * (1 - gap / 0.44) == pytest.approx(each["percent"], abs=0.06)


def test_pages_print(visit, bake, tmp_path):
    page = visit(bake / "bake.html")
    page.emulate_media(media="print")
    assert not page.is_visible("#play") and page.is_visible("#plots svg >> nth=0")
    page.pdf(path=tmp_path / "page.pdf")
    assert (tmp_path / "page.pdf").read_bytes().startswith(b"%PDF") and (tmp_path / "page.pdf").stat().st_size > 20000


def test_sixteen_thousand_people_play_smoothly(throng, visit, tmp_path):
    layout = {"throng": 1, "name": "many", "simulation": {"duration": 3, "seed": 2},
              "formations": [{"id": "everybody", "type": "grid", "origin": [0, 0], "rows": 128, "columns": 128,
                              "spacing": 2, "jitter": 0.3,
                              "goal": {"anywhere": [[0, 0], [254, 254]]}}]}
    (tmp_path / "layout.json").write_text(json.dumps(layout))
    throng("bake", tmp_path / "layout.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    throng("report", tmp_path / "bake", "-o", tmp_path / "page.html")
    page = visit(tmp_path / "page.html")
    page.select_option("#rate", "0.25")
    page.evaluate("play(true)")
    page.wait_for_timeout(500)
    rates = []
    while len(rates) < 12 and max(rates, default=0.0) < 24.0:  # other tests are going on
        before, started = int(page.evaluate("Number(stage.dataset.drawn)")), time.time()
        page.wait_for_timeout(2000)
        rates.append((int(page.evaluate("Number(stage.dataset.drawn)")) - before) / (time.time() - started))
    assert max(rates) >= 24.0, rates
    assert (tmp_path / "page.html").stat().st_size < 3_000_000


@pytest.fixture(scope="module")
def batch(throng, once):
    shut = LAYOUT["walls"] + [{"id": "cage", "points": [[-1, -1], [3, -1], [3, 5], [-1, 5], [-1, -1]]}]
    base = {**LAYOUT, "simulation": {"duration": 4}, "walls": LAYOUT["walls"][:2], "events": []}
    family = {"throng_family": 1, "name": "streams", "base": base,
              "axes": [{"name": "walls", "set": "/walls", "values": [base["walls"], shut[:2] + shut[3:]]},
                       {"name": "rate", "set": ["/flows/0/rate", "/flows/1/rate"], "values": [1, 3]},
                       {"name": "seed", "set": "/simulation/seed", "range": [1, 3]}]}

    def make(folder):
        (folder / "family.json").write_text(json.dumps(family))
        throng("batch", folder / "family.json", "-o", folder / "out", "-q", expect=1)
        throng("report", folder / "out", "--each")

    return once("report-batch", make) / "out"


def cells(page, column):
    names = page.locator("#table thead th").all_inner_texts()
    index = next(i for i, name in enumerate(names) if name.split(" ")[0] == column)
    return page.eval_on_selector_all("#table tbody tr", f"rows => rows.map(row => row.cells[{index}].textContent)")


def test_failures_come_first_and_tell_their_reason(visit, batch):
    page = visit(batch / "report.html")
    assert cells(page, "status") == ["failed"] * 6 + ["ok"] * 6
    assert "nobody can walk" in page.locator("#table tbody tr").first.inner_text()
    assert re.search(r"failed\s+6", page.inner_text("#summary"))


def test_sorting_and_filtering(visit, batch):
    page = visit(batch / "report.html")
    page.click("button[data-column=rate]")
    assert cells(page, "rate") == ["1"] * 6 + ["3"] * 6
    page.click("button[data-column=rate]")
    assert cells(page, "rate") == ["3"] * 6 + ["1"] * 6
    page.fill("#filter", "rate > 1 and status = ok")
    wait_until(page, "document.querySelectorAll('#table tbody tr').length === 3")
    assert set(cells(page, "status")) == {"ok"} and "3 of 12" in page.inner_text("#shown")
    page.fill("#filter", "nobody")
    wait_until(page, "document.querySelectorAll('#table tbody tr').length === 6")
    page.fill("#filter", "rats > 1")
    wait_until(page, "document.getElementById('mistake').textContent.includes('rats')")
    page.fill("#filter", "")
    wait_until(page, "document.querySelectorAll('#table tbody tr').length === 12")
    page.select_option("#columns", "all")
    assert page.locator("#table thead th").count() > 40


def test_thumbnails_scatter_and_one_scenario_with_keys(visit, batch):
    page = visit(batch / "report.html")
    page.fill("#filter", "status = ok")
    wait_until(page, "document.querySelectorAll('#table tbody tr').length === 6")
    page.wait_for_timeout(300)
    assert page.evaluate(f"""(() => {{ {INK}
        return [...document.querySelectorAll('canvas.thumbnail')].slice(0, 3).every(canvas => ink(canvas) > 50); }})()""")
    assert page.locator("#scatter circle").count() == 6
    page.select_option("#x", "agents")
    page.select_option("#y", "mean_speed")
    page.select_option("#z", "seed")
    assert "mean_speed over agents" in page.inner_text("#scatter")
    page.locator("#scatter circle").nth(2).click(force=True)
    assert page.is_visible("#chosen") and page.locator("tr.chosen").count() == 1
    page.focus("#table tbody tr:nth-child(1)")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    assert page.locator("#table tbody tr:nth-child(2)").get_attribute("class") == "chosen"
    link = page.locator("#detail a", has_text="open").get_attribute("href")
    other = visit(batch / link)
    assert other.inner_text("h1") == LAYOUT["name"]


def test_what_is_no_bake_and_no_batch_is_told(throng, tmp_path):
    assert "bake.json" in throng("report", tmp_path, expect=3).stderr


def test_discs_are_as_large_as_the_ground_makes_people(throng, visit, tmp_path):
    ground = {"polygon": [[-9, -9], [9, -9], [9, 9], [-9, 9]], "size": 1.6, "from": 2}
    people = [{"position": [-3, 0], "goal": [3, 0], "radius": 0.25},
              {"position": [20, 0], "goal": [24, 0], "radius": 0.3}]
    (tmp_path / "layout.json").write_text(json.dumps({
        "throng": 1, "simulation": {"duration": 5}, "patches": [ground],
        "formations": [{"id": "two", "type": "agents", "agents": people}]}))
    throng("bake", tmp_path / "layout.json", "-o", tmp_path / "bake", "-q", "--no-gltf")
    throng("report", tmp_path / "bake", "-o", tmp_path / "bake.html")
    page = visit(tmp_path / "bake.html")
    shown = page.evaluate(
        "() => [0, 1].map(row => Array.from({length: crowd.taken}, (_, m) => crowd.radiusOf(row, m)))")
    every = page.evaluate("() => crowd.every")
    told = numpy.load(tmp_path / "bake/streams/size.npy")[..., 1].T / 2
    for row in range(2):
        frames = numpy.minimum(numpy.arange(len(shown[row])) * every, told.shape[1] - 1)
        assert shown[row] == pytest.approx(told[row, frames], abs=0.002)
    assert shown[0][0] == pytest.approx(0.25, abs=0.002) and shown[0][-1] == pytest.approx(0.4, abs=0.002)
