# SPDX-License-Identifier: Apache-2.0
"""The page of `throng watch` in a real, headless Chromium: people move, a changed layout begins anew, mistakes are
shown."""
import json

from conftest import EXAMPLES
from watching import LAYOUT, until, watching, write


def visit(browser, job, problems):
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.goto(f"http://127.0.0.1:{job.listener._port}/")
    page.wait_for_selector("body[data-ready=yes]", timeout=120000)
    return page


def test_people_move_and_a_change_begins_anew(throng, browser, tmp_path):
    path, problems = tmp_path / "layout.json", []
    write(path, LAYOUT)
    with watching(throng, path) as job:
        page = visit(browser, job, problems)
        picture = lambda: page.evaluate("document.getElementById('people').toDataURL()")
        asked = lambda question: page.evaluate(question)
        until(lambda: asked("state.time") > 0.3)
        before = picture()
        until(lambda: picture() != before)
        assert page.inner_text("h1") == LAYOUT["name"] and page.inner_text("#about").startswith("28 people")
        until(lambda: page.inner_text("#state") == "Simulated to its end")
        # Somebody is followed where it goes.
        page.evaluate("play(false); seek(2)")
        x, y = page.evaluate("(() => { draw(); const row = [...crowd.first].findIndex((f, i) => crowd.isThere(i, 48)); "
                             "const at = crowd.placeOf(row, ...Object.values(crowd.momentAt(2))); "
                             "const box = stage.getBoundingClientRect(); "
                             "return [toX(at.x) / pixel + box.left, toY(at.y) / pixel + box.top]; })()")
        page.mouse.click(x, y)
        assert asked("state.following") and asked("state.chosen") is not None
        middle = asked("view.x")
        page.evaluate("seek(4); draw()")
        assert asked("view.x") != middle
        # A change: at a moment that one has stopped at, the same moment of the new crowd.
        changed = json.loads(json.dumps(LAYOUT))
        changed["flows"][0]["count"] = 30
        write(path, changed)
        until(lambda: asked("document.body.dataset.crowds") == "2")
        until(lambda: page.inner_text("#state") == "Simulated to its end" and asked("crowd.end") > 4)
        assert asked("state.time") == 4 and asked("state.playing") is False
        before = picture()
        write(path, json.dumps(changed).replace('"radius"', '"x"').replace('"pillar"', '7'))
        until(lambda: asked("document.body.dataset.state") == "mistaken")
        assert "layout.json:1:" in page.inner_text("#mistakes") and "/walls/0/id" in page.inner_text("#mistakes")
        assert picture() == before, "the crowd before the mistake stays"
        write(path, LAYOUT)
        until(lambda: asked("document.body.dataset.crowds") == "3")
        assert page.is_hidden("#mistakes")
    until(lambda: asked("document.body.dataset.state") == "ended")
    assert problems == []
    page.close()


def test_levels_can_be_chosen(throng, browser):
    problems = []
    with watching(throng, EXAMPLES / "station-levels.json", "--set", "simulation.duration=8") as job:
        page = visit(browser, job, problems)
        until(lambda: page.inner_text("#state") == "Simulated to its end")
        page.evaluate("play(false); seek(8); draw()")
        ink = lambda: page.evaluate("words.reduce((n, word) => n + (word ? 1 : 0), 0)")
        everybody, seen = ink(), []
        for level in page.evaluate("crowd.levels.map((_, i) => i)"):
            page.select_option("#level", str(level))
            page.evaluate("draw()")
            seen.append(ink())
        assert everybody > max(seen) > 0 and sum(seen) >= everybody * 0.8
    assert problems == []
    page.close()
