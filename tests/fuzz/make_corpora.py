#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes what the fuzzers begin with: for each reader a folder of sound inputs, and of some that are wrong in one place,
and a dictionary of words.

Usage: make_corpora.py BUILD   (which has write_sample_bake; writes BUILD/seeds/READER/ and BUILD/words/READER)
"""
import base64
import copy
import itertools
import json
import pathlib
import re
import shutil
import sqlite3
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests" / "authoring")]

import layout_corpus  # noqa: E402
import terrain_files  # noqa: E402

SCHEMAS = {"layout": "authoring/layout/throng-layout.schema.json",
           "family": "authoring/family/throng-family.schema.json",
           "overrides": "authoring/overrides/throng-overrides.schema.json"}


def schema_of(name):
    return json.loads((ROOT / SCHEMAS[name]).read_text())


def sources():
    """Texts of all layouts and families that the project has."""
    for path in sorted([*(ROOT / "examples").glob("*.json"), *(ROOT / "scenarios").rglob("*.json"),
                        *(ROOT / "tests" / "authoring" / "layouts").glob("*.json")]):
        yield json.loads(path.read_text())


def layouts():
    return [source for source in sources() if "throng" in source]


def wrong_layouts(every):
    """One in so many of those that tests/authoring tries."""
    schema = schema_of("layout")
    base = layout_corpus.base_of(schema)
    return [case.layout(base) for case in itertools.islice(layout_corpus.cases_of(schema), 0, None, every)]


def small(layout):
    """The same with few people on a small site, and without what lies in other files."""
    layout = copy.deepcopy(layout)
    layout.pop("terrain", None)
    layout.setdefault("simulation", {}).update(duration=5, warmup=0)
    for flow in layout.get("flows", ()):
        flow.pop("start", None), flow.pop("end", None)
        flow.update({"count": 6} if "count" in flow else {"rate": 1})
    for formation in layout.get("formations", ()):
        for key, most in (("count", 12), ("rows", 3), ("columns", 4), ("radius", 15)):
            if key in formation:
                formation[key] = min(formation[key], most)
    return layout


def compact(value):
    return json.dumps(value, separators=(",", ":")).encode()


def places(value, pointer=()):
    yield pointer, value
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inside in items:
        yield from places(inside, pointer + (str(key),))


def settings():
    every_object = json.loads(layout_corpus.EVERY_OBJECT.read_text())
    for pointer, value in places(every_object):
        if pointer:
            text = json.dumps(value)
            yield f".{'.'.join(pointer)}={text}"[1:].encode()
            yield f"/{'/'.join(pointer)}={text}\nsimulation.seed=7".encode()
    yield b"motion.drive.relaxation=0.7\nname=some name\nsimulation.duration=1e3"


def families():
    yield from (compact(source) for source in sources() if "throng_family" in source)
    base = small(next(layout for layout in layouts() if layout.get("flows")))
    axes = [{"set": "/simulation/seed", "range": [1, 3]},
            {"set": ["/flows/0/count", "/flows/0/people/radius"], "values": [1, 2]},
            {"set": "/new/key", "values": [{"a": []}, None]}]
    drawn = [{"set": "/simulation/duration", "uniform": [1, 5], "whole": True},
             {"set": "/flows/0/count", "normal": [5, 2], "min": 1, "max": 9},
             {"name": "odd", "set": "/simulation/smoothing", "log_normal": [0, 1], "max": 1},
             {"set": "/name", "values": ["a", "b"], "weights": [1, 2]}]
    yield compact({"throng_family": 1, "base": base, "axes": axes, "bake": {"keep": False, "density": True}})
    yield compact({"throng_family": 1, "base": "base.json", "axes": axes[:1]})
    for sampling in ("random", "latin"):
        yield compact({"throng_family": 1, "name": "drawn", "base": base, "sampling": sampling, "count": 9, "seed": 3,
                       "axes": drawn})
    for kind in ("crossing", "corridor", "streets", "plaza", "stadium"):
        yield compact({"throng_family": 1, "generate": {"kind": kind}, "sampling": "latin", "count": 4,
                       "axes": [{"parameter": "seed", "uniform": [1, 100], "whole": True}]})


def overrides():
    people = [(0, "eastbound", 0, [-15, -3.6, 0]),
              (1, "north, \"bound\"", 0, [3.6, -15, 0]), (4, "eastbound", 4, [-15, 0, 0])]
    changes = [{"hide": True}, {"character": 2, "scale": 1.1}, {"tint": "#a01020"}, {"tint": [0.1, 0.5, 1]},
               {"move": {"by": [0, 1.5, 0], "turn": 30}},
               {"retime": {"offset": -3, "speed": 1.5}}, {"hero": "she", "note": "x"}, {}]
    for change in changes:
        yield compact({"throng_overrides": 1, "overrides": [
            {"id": row, "group": group, "spawn": {"frame": frame, "position": place}, **change}
            for row, group, frame, place in people]})
    person = {"id": 0, "group": "eastbound", "spawn": {"frame": 0, "position": [-15, -3.6, 0]}}
    selectors = [{"everybody": True}, {"group": ["eastbound", "x"], "rows": [0, 3]}, {"party": [1, 2]},
                 {"with": {"people": [person]}},
                 {"region": {"polygon": [[-20, -9], [0, -9], [0, 9]], "frames": [0, 5]}},
                 {"share": {"of": 0.5, "seed": 2}}, {"near": {"point": [-15, 0], "within": 4}},
                 {"near": {"wall": "corner", "within": 9}}, {"near": {"who": {"rows": [0, 0]}, "within": 3}},
                 {"seen": {"views": [{"matrix": [1, 0, 0, -12, 0, 1, 0, 0, 0, 0, 1, 10, 0, 0, 0, 1], "size": [1, 1]}]}},
                 {"and": [{"profile": "a"}, {"look": "b"}], "not": {"changed": True}}, {"or": [{"copies": "before"}]}]
    operations = [{"hide": {"frames": [1, 3]}}, {"move": {"turn": 20, "about": [0, 0]}, "retime": {"offset": 2}},
                  {"clip": {"activity": "queues"}}, {"look_at": {"person": person}}, {"hero": "she", "scale": 1.2},
                  {"duplicate": {"copies": 2, "by": [1, 0, 0], "scatter": 1}},
                  {"bend": {"points": [{"frame": 3, "by": [0, 1]}, {"frame": 6, "by": [0, -1]}], "falloff": 2}},
                  {"bend": {"points": [{"way": 0.2, "by": [0, 0.1]}]}}]
    before = {"name": "before", "who": {"rows": [0, 1]}, "do": {"duplicate": {}}}
    for index, who in enumerate(selectors):
        yield compact({"throng_overrides": 1, "overrides": [], "layers": [
            before, {"name": "then", "who": who, "do": operations[index % len(operations)]}]})


def terrains():
    flat = terrain_files.surface(lambda x, y: 0.1 * x, (-2, -2), (10, 10), 4)
    hill = terrain_files.surface(lambda x, y: (x - 4) * (y - 4) / 8, (-2, -2), (10, 10), 1.5)
    stairs = terrain_files.stairs(5, 0.3, 0.17, 5, 9)
    for mesh in (flat, hill, stairs):
        yield terrain_files.glb(*mesh)
    yield terrain_files.glb(*flat, nodes=[{"children": [1, 2]}, 
                                          {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1]},
                                          {"mesh": 0, "scale": [-1, 1, 1], "rotation": [0, 0.7, 0, 0.7],
                                           "translation": [1, 0, 0]}])
    whole = terrain_files.glb(*flat)
    length = struct.unpack_from("<I", whole, 12)[0]
    document, binary = json.loads(whole[20:20 + length]), whole[28 + length:]
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    yield compact(document)
    for mode in (4, 5, 6):
        document = json.loads(whole[20:20 + length])
        document["meshes"][0]["primitives"][0]["mode"] = mode
        document["accessors"].append({**document["accessors"][0]})
        document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2
        document["bufferViews"][0]["byteStride"] = 12
        yield terrain_files.pack(document, binary)


def folder_as_input(folder):
    parts = b""
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix().encode()
        if path.is_file() and not (name.endswith(b".pc2") and name != b"streams/pos.pc2"):
            content = path.read_bytes()
            parts += bytes([len(name)]) + name + struct.pack("<I", len(content)) + content
    return parts


def bakes(build, folder):
    """Folders of bakes of nobody, of few, and of some who arrive."""
    for number, words in enumerate((("agents=0", "frames=2"), ("agents=6", "frames=8"),
                                    ("agents=3", "frames=3", "x=500000.25", "y=5600000"), ("agents=12", "frames=40"),
                                    ("agents=6", "frames=80", "packed=1"))):
        made = folder / f"bake{number}"
        subprocess.run([next(build.glob("tests/*/write_sample_bake")), made, *words, "gltf=-1"],
                       check=True, stdout=subprocess.DEVNULL)
        yield made


def packed():
    """What packed.cpp takes: a directory whose blocks have no sizes yet, and what is in them."""
    for frames, people, in_block, late in ((3, 2, (64, 1024), ()), (70, 3, (64, 1024), (1,)), (9, 5, (4, 2), (0, 4))):
        head = struct.pack("<6I", 1, frames, people, *in_block, 3)
        head += b"".join(struct.pack("<dII", step, before, 0) for step, before in ((2 ** -14, 1), (2 ** -11, 2), (1, 0)))
        sizes = [(min(in_block[0], frames - frame), min(in_block[1], people - row))
                 for frame in range(0, frames, in_block[0]) for row in range(0, people, in_block[1])]
        first = [2 if row in late else 0 for row in range(people)]
        directory = head + bytes(4 * len(sizes)) + struct.pack(f"<{people}I", *first) + \
            struct.pack("<3i", 5, -7, 1) * len(late)
        yield struct.pack("<H", len(directory)) + directory + b"".join(
            struct.pack("<H", len(content)) + content for content in map(packed_block, sizes))
        yield struct.pack("<H", len(directory)) + directory


def packed_block(size):
    cells = size[0] * size[1]
    planes = ((2, 2), (1, 1), (0, 1))  # order and bytes of each component
    return bytes(number for pair in planes for number in pair) + \
        b"".join(bytes((7 * cell + plane) % 5 for cell in range(cells)) for _, count in planes for plane in range(count))


def streams(folders):
    for folder in folders:
        for path in sorted((folder / "streams").iterdir()):
            content = path.read_bytes()
            yield content
            yield content[:-12]
    yield b"POINTCACHE2\0" + struct.pack("<iiffi", 1, 0, 1, 1, 1000)


CHECKPOINT_HEADER = 24  # bytes: the magic word, how long the content is, and its hash


def checkpoints(build, folder):
    """What io/checkpoint.cpp writes behind its header, for the bake of checkpoint.cpp: six people, eight frames. Some
    are real ones, of streams in both kinds of forms."""
    for number, words in enumerate((("packed=0", "checkpoint=5"), ("packed=1", "checkpoint=5"),
                                    ("packed=1", "checkpoint=0"))):
        made = subprocess.run([next(build.glob("tests/*/write_sample_bake")), folder / f"unfinished{number}", "agents=6",
                               "frames=8", "diagrams=4", "gltf=-1", *words], check=True, capture_output=True, text=True)
        for file in sorted(pathlib.Path(made.stdout.strip()).glob("checkpoint.*")):
            yield file.read_bytes()
            yield file.read_bytes()[CHECKPOINT_HEADER:]

    def piece(content):
        return struct.pack("<Q", len(content)) + content

    first_alive = struct.pack("<6I", 0, 0, 0, 0, 5, 0xffffffff)
    walkers = struct.pack("<I", 0) + bytes(6 * 40)
    for frames, diagrams in ((0, 0), (4, 1), (5, 2)):
        sections = {b"first alive": first_alive, b"gaits walked": struct.pack("<I", 1),
                    b"diagrams": struct.pack("<IIIxxxxddd", diagrams, 128, 96, 4.0, -16.0, -16.0),
                    b"seconds": struct.pack("<d", 1.5)}
        for motion in (None, walkers + struct.pack("<3Q", 0, 0, 0)):
            content = sections if motion is None else {**sections, b"motion": motion}
            yield piece(b"a layout") + struct.pack("<3Q", frames, 2 * frames, len(content)) + \
                b"".join(piece(name) + piece(section) for name, section in content.items())


def databases(folder):
    for number, page in enumerate((512, 1024, 4096)):
        path = folder / f"{number}.sqlite"
        with sqlite3.connect(path) as database:
            database.execute(f"PRAGMA page_size = {page}")
            database.executescript("""
                CREATE TABLE scenarios (id TEXT PRIMARY KEY, number INTEGER NOT NULL, status TEXT, reason TEXT,
                                        agents INTEGER, seconds REAL, bake TEXT, log TEXT) WITHOUT ROWID;
                CREATE TABLE parameters (id TEXT PRIMARY KEY, "rate", "name") WITHOUT ROWID;
                CREATE VIEW results AS SELECT scenarios.*, parameters."rate" AS "rate"
                    FROM scenarios JOIN parameters USING (id);
                CREATE TABLE batch (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;
                INSERT INTO batch VALUES ('name', 'some'), ('base', 'street.json');""")
            for i in range(4 * number + 2):
                database.execute("INSERT INTO scenarios VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                                 (f"{i:016x}", i + 1, "ok" if i else "failed", None, 5, 1.5 * i, "bakes/x", None))
                database.execute("INSERT INTO parameters VALUES (?, ?, ?)", (f"{i:016x}", 0.5 * i, "a,\"b\"\n"))
        yield path.read_bytes()


def calibrations():
    gather = {"block_width": 8, "block_height": 4, "bin_radii": 1.5}
    costs = [{"method": method, "base_ms": 0.1, "pixel_ns": 1.5, "site_ns": 20, "covered_ns": 2}
             for method in ("gradient1", "gradient2", "per-site")]
    costs.append({"method": "binned", "base_ms": 0.2, "pixel_ns": 1, "site_ns": 1, "covered_ns": 0, "gather": gather})
    version = re.search(r"project\(throng VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
    too_high = {**costs[-1], "gather": {**gather, "block_height": 4.6e18}}
    for some in (costs, costs[:1], costs[-1:], [too_high]):
        yield compact({"throng-calibration": 1, "version": version, "device": "any / 1", "costs": some})


def words_of(*documents):
    """All keys and short texts."""
    found = set()
    for document in documents:
        for pointer, value in places(document):
            found.update(pointer[-1:])
            if isinstance(value, str) and len(value) <= 40:
                found.add(value)
    return found


DICTIONARIES = {
    "settings": lambda: words_of(schema_of("layout")) |
    {"=", ".", "/", "~0", "~1", "[0, 1]", "{}", "-1", "1e300", "null"},
    "streams": lambda: {"POINTCACHE2", "THRONGP1", "THRONGPE", "\\x93NUMPY\\x01\\x00", "'descr': '<f4'", "'fortran_order': False",
                         "'shape': (", ", 3), }"},
    "results": lambda: {"SQLite format 3", "CREATE TABLE", "CREATE VIEW", "WITH RECURSIVE", "SELECT", "randomblob(",
                        "zeroblob(",
                        "printf('%.*c', 1000000000, 'x')", "scenarios", "results", "batch", "WITHOUT ROWID",
                        "PRIMARY KEY"},
    "checkpoint": lambda: {"THRONGC1", "first alive", "gaits walked", "diagrams", "motion", "seconds", "packed pos",
                           "packed dir", "packed state", "hash of pos", "hash of dir", "hash of state"},
    "bake": lambda: {"id,group,kind,radius,preferred_speed", "spawn_frame", "arrival_frame", "nan", "inf", "1e308",
                     "walking", "arrived",
                     "refused", "\\x93NUMPY\\x01\\x00", "'shape': ("},
}
DICTIONARIES["analysis"] = DICTIONARIES["bake"]


def corpora(build, folder):
    baked = list(bakes(build, folder))
    folders = [folder_as_input(bake) for bake in baked]
    return {
        "layout": [compact(layout) for layout in layouts() + wrong_layouts(9)],
        "scene": [compact(small(layout)) for layout in layouts() + wrong_layouts(40)],
        "settings": settings(), "family": families(), "overrides": overrides(), "terrain": terrains(),
        "bake": folders, "analysis": folders, "streams": streams(baked), "packed": packed(),
        "checkpoint": checkpoints(build, folder),
        "results": databases(folder), "calibration": calibrations(),
    }


def main(build):
    for old in ("seeds", "words"):
        shutil.rmtree(build / old, ignore_errors=True)
    (build / "words").mkdir(parents=True)
    with tempfile.TemporaryDirectory() as folder:
        for reader, inputs in corpora(build, pathlib.Path(folder)).items():
            (build / "seeds" / reader).mkdir(parents=True)
            for number, content in enumerate(inputs):
                (build / "seeds" / reader / f"{number:04}").write_bytes(content)
    for reader, words in DICTIONARIES.items():
        lines = [word.replace('"', '\\"') if "\\x" in word else
                 word.replace("\\", "\\\\").replace('"', '\\"') for word in words()]
        (build / "words" / reader).write_text(
            "".join(f'"{line}"\n' for line in sorted(lines) if line.isascii() and line.isprintable()))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
