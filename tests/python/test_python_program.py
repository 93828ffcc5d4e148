# SPDX-License-Identifier: Apache-2.0
"""throng_io runs the program: progress, mistakes as exceptions with their places, batches as tables."""
import pathlib
import subprocess
import sys

import pytest

import throng_io
from conftest import ROOT

RING = {"throng": 1, "simulation": {"duration": 6},
        "formations": [{"id": "ring", "type": "circle", "centre": [0, 0], "radius": 3, "count": 6}]}


def test_a_dict_is_baked_with_progress(throng, tmp_path):
    seen = []
    bake = throng_io.bake(RING, tmp_path / "ring", progress=seen.append, settings={"simulation.duration": 1},
                          program=throng.binary)
    assert bake.frames == 24 and seen[-1]["progress"] == 100 and seen[-1]["frames"] == 24
    assert not (bake.folder / "crowd.glb").exists()
    assert throng_io.measure(bake, throng.binary)["agents"] == 6
    with pytest.raises(throng_io.ProgramError, match="exists|already"):
        throng_io.bake(RING, tmp_path / "ring", program=throng.binary)
    again = throng_io.bake(RING, tmp_path / "ring", force=True, gltf=True, settings={"simulation.duration": 0.5},
                           program=throng.binary)
    assert again.frames == 12 and (again.folder / "crowd.glb").exists()


def test_mistakes_have_a_place_and_a_hint(throng, tmp_path):
    wrong = {"throng": 1, "flowz": [], "roads": [{"id": "a", "centreline": [[0, 0]]}]}
    with pytest.raises(throng_io.InvalidLayout) as told:
        throng_io.bake(wrong, tmp_path / "wrong", program=throng.binary)
    key, points = told.value.diagnostics
    assert key.pointer == "/flowz" and key.hint == "did you mean `flows`?" and key.line == 1
    assert points.pointer == "/roads/0/centreline" and "at least 2 points" in str(told.value)
    assert told.value.code == 3 and not (tmp_path / "wrong").exists()
    assert [each.pointer for each in throng_io.check(wrong, throng.binary)] == ["/flowz", "/roads/0/centreline"]
    assert throng_io.check(RING, throng.binary) == []
    with pytest.raises(throng_io.ThrongError, match="as JSON"):
        throng_io.bake({"throng": float("nan")}, tmp_path / "wrong", program=throng.binary)


def test_what_raises_in_progress_stops_the_program(throng, tmp_path):
    def stop(event):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        throng_io.bake({**RING, "simulation": {"duration": 600}}, tmp_path / "ring", progress=stop,
                       options=("--checkpoint", "0"), program=throng.binary)
    assert not (tmp_path / "ring").exists()


def test_no_program_is_told(tmp_path, monkeypatch):
    monkeypatch.setenv("THRONG_BINARY", str(tmp_path / "throng"))
    with pytest.raises(throng_io.ThrongError, match="THRONG_BINARY"):
        throng_io.bake(RING, tmp_path / "ring")


def test_batches_are_tables(throng, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    family = {"throng_family": 1, "base": {**RING, "simulation": {"duration": 1}}, "bake": {"keep": True},
              "axes": [{"set": "/formations/0/count", "values": [4, 6], "name": "how many"}]}
    batch = throng_io.batch(family, tmp_path / "rings", program=throng.binary)
    table = batch.table().sort_values("how many")
    assert list(table["how many"]) == [4, 6] and list(table.agents) == [4, 6] and set(table.status) == {"ok"}
    assert batch.bake(table.index[1]).agents == 6
    assert sorted(path.name for path in tmp_path.iterdir()) == ["rings"]
    with pytest.raises(throng_io.ThrongError, match="results.sqlite is not there"):
        throng_io.Batch(tmp_path)


def test_extras_are_named_where_they_are_missing():
    """In a Python that hides them."""
    code = ("import sys; sys.modules.update(dict.fromkeys(['pedpy', 'pandas']))\n"
            "import throng_io\n"
            "from throng_io.base.errors import need\n"
            "try: need('pedpy', 'pedpy')\n"
            "except throng_io.MissingExtra as error: print(error)\n")
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True,
                          env={"PYTHONPATH": str(ROOT / "python" / "src")}).stdout
    assert "pedpy is not installed" in told and 'pip install "throng-io[pedpy]"' in told


@pytest.mark.slow
def test_the_page_makes_its_picture(throng, tmp_path):
    """The first example of docs/python.md, as it stands there."""
    pytest.importorskip("pedpy", reason="PedPy is not installed")
    page = (ROOT / "docs" / "python.md").read_text().split("## From a layout to a fundamental diagram")[1]
    lines = []
    for line in page.splitlines():
        if line.startswith("    ") or (lines and not line):
            lines.append(line[4:])
        elif lines:
            break
    assert 20 <= len([line for line in lines if line]) <= 24
    subprocess.run([sys.executable, "-c", "\n".join(lines)], check=True, cwd=tmp_path, capture_output=True,
                   env={"PYTHONPATH": str(ROOT / "python" / "src"), "THRONG_BINARY": throng.binary,
                        "MPLBACKEND": "agg", "MPLCONFIGDIR": str(tmp_path), "PATH": "/usr/bin:/bin"})
    assert (tmp_path / "fundamental-diagram.png").stat().st_size > 10000
    bake = throng_io.Bake(pathlib.Path(tmp_path) / "corridor")
    assert bake.agents == 130 and bake.account["arrived"] > 30
