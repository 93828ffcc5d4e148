# SPDX-License-Identifier: Apache-2.0
"""Bakes of layouts that tests write, and what is in them."""
import csv
import json

import numpy


class Bake:
    """A bake's manifest, its table of people, and its streams."""

    def __init__(self, path):
        self.path = path
        self.manifest = json.loads((path / "bake.json").read_text("utf-8"))
        self.pos, self.dir, self.state = (numpy.load(path / "streams" / f"{name}.npy")
                                          for name in ("pos", "dir", "state"))
        with open(path / "agents.csv", encoding="utf-8", newline="") as file:
            self.rows = list(csv.DictReader(file))


def baker(throng, folder, *always):
    """(name, layout, options) gives the bake's folder. @param always options of all of them"""
    def bake(name, layout, *options):
        path = folder / f"{name}.json"
        path.write_text(json.dumps(layout), "utf-8")
        throng("bake", path, "-o", folder / name, "--no-gltf", "-q", *always, *options)
        return folder / name
    return bake
