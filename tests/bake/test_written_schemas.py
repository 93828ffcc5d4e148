# SPDX-License-Identifier: Apache-2.0
"""What the program writes is what the schemas of it say."""
import json
import pathlib
import sys

import jsonschema
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import terrain_files  # noqa: E402

RING = {"throng": 1, "simulation": {"duration": 0.5}, "formations": [
    {"id": "ring", "type": "circle", "centre": [10, 10], "radius": 4, "count": 6}]}
KINDS = ["layout", "family", "overrides", "bake", "measure", "result", "batch"]


@pytest.fixture(scope="module")
def checked(throng):
    """checked("bake", document): every mistake in a document is an error, and so is a key that no schema has."""

    def check(kind, document):
        schema = json.loads(throng("schema", *([f"--{kind}"] if kind != "layout" else [])).stdout)
        jsonschema.Draft7Validator.check_schema(schema)
        jsonschema.Draft7Validator(schema).validate(document)

    return check


def test_each_schema_keeps_its_name(throng):
    for kind in KINDS:
        schema = json.loads(throng("schema", *([f"--{kind}"] if kind != "layout" else [])).stdout)
        assert schema["$id"] == f"https://throng.example/schema/{kind}-1.json"
    assert "give one flag" in throng("schema", "--bake", "--batch", expect=2).stderr


def test_bakes_and_measures_are_as_their_schemas_say(throng, checked, bakes, tmp_path, manifest_of):
    checked("bake", manifest_of(bakes("intersection")))  # with diagrams and glTF
    ground = terrain_files.glb(*terrain_files.surface(lambda x, y: 0.05 * x, (-20, -20), (40, 40), 10.0))
    (tmp_path / "slope.glb").write_bytes(ground)
    layout = {**RING, "terrain": {"file": "slope.glb"}, "events": [{"at": 0.2, "open": "gate"}],
              "walls": [{"id": "gate", "points": [[10, 10], [11, 10]], "thickness": 0.2}],
              "patches": [{"polygon": [[0, 0], [9, 0], [9, 9]], "cost": 2, "until": 0.4}],
              "given": [{"id": "given", "people": {"body": "adult"}, "ways": [[[0, 2, 2], [9, 9, 2]]]}]}
    (tmp_path / "ring.json").write_text(json.dumps(layout))
    throng("bake", tmp_path / "ring.json", "-o", tmp_path / "ring", "-q", "--density", "--feet",
           "--gaze", "--attention", "--wish", "--set", "simulation.seed=3")
    checked("bake", manifest_of(tmp_path / "ring"))
    (tmp_path / "changes.json").write_text(json.dumps({"throng_overrides": 1, "overrides": [
        {"id": 0, "group": "ring", "spawn": {"frame": 0, "position": [14, 10, 0.7]}, "hide": True}]}))
    throng("apply", tmp_path / "ring", "--overrides", tmp_path / "changes.json", "-o", tmp_path / "applied", "-q")
    checked("bake", manifest_of(tmp_path / "applied"))
    checked("measure", json.loads(throng("measure", tmp_path / "ring", "--json").stdout))
    wrong = manifest_of(tmp_path / "ring")
    wrong["streams"]["pos"]["units"] = ["m"]
    with pytest.raises(jsonschema.ValidationError):
        checked("bake", wrong)


def test_batches_are_as_their_schemas_say_and_are_of_one_build(throng, checked, tmp_path):
    plan = tmp_path / "family.json"
    plan.write_text(json.dumps({"throng_family": 1, "name": "rings", "base": RING, "axes": [
        {"name": "seed", "set": "/simulation/seed", "values": [1, 2]},
        {"name": "count", "set": "/formations/by-id/ring/radius", "values": [4, 1e6]}]}))
    command = ["batch", plan, "-o", tmp_path / "out"]
    told = throng(*command, "--json", "--workers", "1", expect=1)
    checked("batch", json.loads(told.stdout))
    results = {path: json.loads(path.read_text()) for path in (tmp_path / "out" / "results").glob("*.json")}
    assert sorted(result["status"] for result in results.values()) == ["failed", "failed", "ok", "ok"]
    for result in results.values():
        checked("result", result)

    build = throng("--version").stdout.split("build ")[1].strip()
    assert {result["build"] for result in results.values()} == {build}
    assert throng("batch", "query", tmp_path / "out", "--columns", "build", "--where", "status = 'ok'", "--csv") \
        .stdout.split() == ["build", build, build]
    path, result = next((path, result) for path, result in results.items() if result["status"] == "ok")
    path.write_text(json.dumps({**result, "build": "another"}))
    told = throng(*command, "--dry-run").stdout
    assert f"1 were made by another build of throng (this is {build})" in told and "1 are done" in told
    throng(*command, "-q", expect=1)
    assert json.loads(path.read_text())["build"] == build
