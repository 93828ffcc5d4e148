# SPDX-License-Identifier: Apache-2.0
"""Crowds as Alembic and USD, by Blender's own exporters: copies of crowds that these know are made in a scene of their
own, and thrown away afterwards. The scene stays as it is, also where something goes wrong."""
import contextlib
import os

import bpy
import numpy

from ..crowd import copies
from ..crowd.chosen import Streams, View, rows_of, vertices_of
from ..crowd.queries import cast_of
from . import culling, export

LEVELS = {"fine": 0, "middle": 1, "far": 2}
# Bytes of a file, measured: of a vertex in a frame (its place and velocity), of a vertex where people come or go (faces
# and materials), of an arrow in both cases, and of all else.
MOVED, SHAPED, ARROW, ARROW_SHAPED, AROUND = 24.0, 20.0, 128.0, 110.0, 6_000
_SET = ("MESH", "CAMERA", "LIGHT")


class Unwritten(Exception):
    """No file was written; the message says why."""


class Plan:
    """Of some crowds, who is written and what that takes."""

    def __init__(self, crowds, first, last, wanted):
        self.first, self.last, self.frames, self.wanted = first, last, last - first + 1, wanted
        self.rows, self.there, self.people, self.vertices, self.bytes = {}, 0, 0, 0, float(AROUND)
        for crowd in crowds:
            streams = Streams(crowd, first, last)
            presence = streams.presence()
            rows = rows_of(streams, wanted.most, wanted.view)
            self.rows[crowd] = rows
            self.there += int((presence > 0).sum())
            self.people += len(rows)
            if wanted.bodies:
                counts = vertices_of(crowd, rows, streams.variations(), self.level_of(crowd))
                self.vertices += int(counts.sum())
                self.bytes += float((counts * presence[rows]).sum()) * MOVED
                self.bytes += streams.anew(rows, counts) * SHAPED
            if wanted.points:
                self.bytes += float(presence[rows].sum()) * ARROW
                self.bytes += streams.anew(rows, numpy.ones(len(rows), int)) * ARROW_SHAPED

    def is_bent(self, crowd):
        return self.wanted.detail == "fine" and copies.bends(crowd)

    def level_of(self, crowd):
        level = LEVELS[self.wanted.detail]
        if level >= cast_of(crowd)["throng_levels"]:
            raise Unwritten(f"{crowd.name} has no coarser meshes: switch Levels of Detail on (sidebar, Throng), or "
                            "choose Fine")
        return level

    def lines(self):
        """What is told before anything is written."""
        yield f"{self.people:,} of {self.there:,} people, {self.frames:,} frames"
        yield (f"{self.vertices:,} vertices a frame at most" if self.wanted.bodies else "Arrows, no bodies")
        yield f"About {megabytes(self.bytes)}" + (", and the set" if self.wanted.setting else "")


class Wanted:
    """What goes into a file."""

    def __init__(self, bodies=True, points=True, setting=False, most=100, detail="fine", view=None):
        self.bodies, self.points, self.setting = bodies, points, setting
        self.most, self.detail, self.view = most, detail, view


def view_of(scene):
    """Of the scene's camera as it is now, where there is one."""
    camera = scene.camera
    if not camera or camera.type != "CAMERA":
        return None
    matrix = camera.matrix_world
    return View(tuple(matrix.translation), tuple(tuple(axis.normalized()) for axis in matrix.to_3x3().col),
                culling.field_of_view(camera, scene))


def megabytes(size):
    return f"{size / 1e6:,.1f} MB" if size < 1e8 else f"{size / 1e6:,.0f} MB"


def there(operator):
    """Whether this Blender is built with an exporter: Debian's 3.4 has neither."""
    try:
        return bool(operator.get_rna_type())
    except (KeyError, AttributeError, RuntimeError):
        return False


@contextlib.contextmanager
def _whole(path):
    """A name beside a file, for what then takes its place, or nothing does."""
    folder, name = os.path.split(os.path.abspath(path))
    if os.path.isdir(path):
        raise Unwritten(f"{path} is a folder: name a file in it")
    if not os.path.isdir(folder):
        raise Unwritten(f"there is no folder {folder}")
    beside = os.path.join(folder, f".{os.getpid()}-{name}")
    try:
        with open(beside, "wb"):
            pass  # whether one may write there is known before the work
        yield beside
        if not os.path.getsize(beside):
            raise Unwritten("Blender's exporter wrote nothing: its console says why")
        os.replace(beside, path)
    except OSError as error:
        raise Unwritten(f"{path} cannot be written: {error.strerror}") from None
    finally:
        with contextlib.suppress(OSError):
            os.unlink(beside)


@contextlib.contextmanager
def _scene_of(scene, plan):
    """A scene with copies of what goes into the file, and nothing else."""
    made, copied = bpy.data.scenes.new("Throng export"), []
    try:
        made.render.fps, made.render.fps_base = scene.render.fps, scene.render.fps_base
        made.frame_start, made.frame_end, made.camera = plan.first, plan.last, scene.camera
        fps = scene.render.fps / scene.render.fps_base
        for crowd, rows in plan.rows.items():
            if plan.wanted.bodies:
                copied.append(copies.body_copy(crowd, rows, plan.level_of(crowd), plan.is_bent(crowd), fps))
            if plan.wanted.points:
                copied.append(copies.arrow_copy(crowd, rows, fps))
        if plan.wanted.setting:
            _add_set(scene, made, set(plan.rows), copied)
        for each in copied:
            made.collection.objects.link(each.made)
        made.frame_set(plan.first)
        yield made
    finally:
        bpy.data.scenes.remove(made)
        for each in copied:
            each.drop()


def _add_set(scene, made, crowds, copied):
    """All else that the pictures show; what has nodes is a copy whose instances are realised."""
    for thing in scene.objects:
        if thing in crowds or thing.type not in _SET or "throng_cast" in thing:
            continue
        if any(modifier.type == "NODES" for modifier in thing.modifiers):
            copy = copies.Copy(thing, thing.name)
            copy.add(export.MODIFIER, export.realising_tree())
            copied.append(copy)
        else:
            made.collection.objects.link(thing)


def write(context, path, plan, save):
    """The file's size. @param save (path) calls Blender's exporter. @throws Unwritten"""
    if not plan.people:
        raise Unwritten(f"nobody is there from frame {plan.first} to {plan.last}")
    with _whole(path) as beside, _scene_of(context.scene, plan) as made:
        try:
            with context.temp_override(scene=made, view_layer=made.view_layers[0]):
                save(beside)
        except RuntimeError as error:
            raise Unwritten(f"Blender's exporter: {str(error).strip()}") from None
    return os.path.getsize(path)
