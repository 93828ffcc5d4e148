# SPDX-License-Identifier: Apache-2.0
"""The live preview: a `throng watch` beside Blender, what it tells in the viewport, and the layout written anew
whenever it has changed."""
import os
import time

import bpy
from bpy.app.handlers import persistent

from ..authoring.bake_operator import LayoutFile, list_problems, remembered
from ..authoring.bake_job import Diagnostic
from ..authoring.exporter import default_name, export_layout, layout_text, origin_of, write_text
from ..authoring.geometry import AuthoringError
from . import discs
from .job import WatchJob

DELAY = 0.3      # s from the last change to the next crowd
_EVERY = 0.05    # s between looks
_running = {}    # the one there is: "preview"


def running():
    """The preview under way, or None."""
    return _running.get("preview")


class Preview:
    """One of them. `tick()` is called now and then and never waits."""

    def __init__(self, context, executable, bake=None):
        """@param bake the folder of one under way, instead of the scene's layout. Raises AuthoringError"""
        self.scene_name, self.bake = context.scene.name, bake
        self.file = None if bake else LayoutFile(context, ".throng-live")
        self._text = None if bake else self._layout(context)
        self._changed_at, self._seen, self._shown, self._crowds, self._problems = None, -1, None, 0, None
        self._begin = time.monotonic()
        self.job = WatchJob(executable, bake or self.file.path)
        self.job.start()
        _running["preview"] = self

    # ---- the layout

    def _layout(self, context):
        document, sources = export_layout(context)
        self._sources = remembered(sources)
        document.setdefault("name", default_name(context.scene))
        return layout_text(document)

    def touch(self):
        """Something has changed, perhaps the layout."""
        if not self.bake:
            self._changed_at = time.monotonic()

    def _write(self, context):
        """The layout, if it is not as it was."""
        self._changed_at = None
        try:
            text = self._layout(context)
            if text != self._text:
                write_text(self.file.path, text)
                self._text = text
        except AuthoringError as error:
            list_problems(context, [Diagnostic("error", "", str(error), "", 0, 0)], {})

    # ---- the crowd

    def tick(self, context):
        """Whether it goes on."""
        if context.scene.name != self.scene_name or not self.job.is_running():
            return False
        if self._changed_at is not None and time.monotonic() - self._changed_at >= DELAY and \
                context.mode == "OBJECT":
            self._write(context)
        listener = self.job.listener
        if listener is None:
            return True
        if listener.crowds != self._crowds:
            self._crowds = listener.crowds
            if not listener.crowd.about.get("continues"):
                self._begin = time.monotonic()
        if listener.changes != self._seen:
            self._seen = listener.changes
            self._tell(context, listener.told)
        moment = (self._seen, round(self.frame(context.scene), 2))
        if moment != self._shown:
            self._shown = moment
            redraw(context)
        return True

    def _tell(self, context, told):
        diagnostics = told.get("diagnostics")
        if diagnostics is not None and diagnostics != self._problems:
            self._problems = diagnostics
            list_problems(context, [Diagnostic(each["severity"], each["pointer"], each["message"], each["hint"],
                                               each["line"], each["column"]) for each in diagnostics],
                          {} if self.bake else self._sources)

    def frame(self, scene):
        """Of the crowd, from 0: what the timeline shows, or what has been played since it began."""
        crowd = self.job.crowd
        if crowd is None:
            return 0.0
        if scene.throng_live_clock == "TIMELINE":
            return scene.frame_current_final - scene.frame_start
        return min((time.monotonic() - self._begin) * crowd.about["fps"], crowd.end or 0)

    def discs(self, scene):
        """(places, radii, colours) in the scene, at the moment."""
        crowd = self.job.crowd
        places, rows = crowd.at(self.frame(scene))
        places[:, :2] += [baked - here for baked, here in zip(crowd.about["origin"], origin_of(scene))]
        return places, crowd.radii[rows], crowd.colours[rows]

    def status(self):
        """A line that says how it goes."""
        told, crowd = self.job.told, self.job.crowd
        state = told.get("state", "")
        if state == "mistaken":
            return "The layout has mistakes: the crowd is from before them" if crowd else "The layout has mistakes"
        if not crowd:
            return "Setting up"
        fps = crowd.about["fps"]
        words = {"warming up": f"Warming up, {100 * told.get('warmup', 0):.0f} %",
                 "complete": "Simulated to its end", "full": "As much as there is room for",
                 "baked": "A complete bake", "partial": "A bake that was stopped",
                 "gone": "The bake was stopped; this is as far as it had come"}
        so_far = f"{told.get('frame', 0) / fps:.1f} of {crowd.about['frames'] / fps:.1f} s"
        verb = "Being baked: played as far as it has come," if state == "baking" else "Simulating:"
        return words.get(state, f"{verb} {so_far}")

    def end(self):
        self.job.stop()
        if self.file:
            self.file.remove()
        _running.pop("preview", None)


def redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def _draw():
    preview, scene = running(), bpy.context.scene
    if preview and preview.job.crowd and scene.name == preview.scene_name:
        discs.draw(*preview.discs(scene))


@persistent
def _on_change(_scene, _depsgraph=None):
    if running():
        running().touch()


@persistent
def _on_load(*_):
    stop()


def _tick():
    preview = running()
    if preview is None:
        return None
    if preview.tick(bpy.context):
        return _EVERY
    bpy.context.scene.throng_live_message = preview.job.message
    stop()
    return None


def start(context, executable, bake=None):
    """Begins one, in the place of one that there is. Raises AuthoringError."""
    stop()
    context.scene.throng_live_message = ""
    preview = Preview(context, executable, os.path.abspath(bake) if bake else None)
    discs.show(_draw)
    bpy.app.handlers.depsgraph_update_post.append(_on_change)
    bpy.app.handlers.load_pre.append(_on_load)
    if not bpy.app.background:
        bpy.app.timers.register(_tick, first_interval=_EVERY, persistent=True)
    return preview


def stop():
    """Ends it, if there is one."""
    preview = running()
    if preview is None:
        return
    preview.end()
    discs.hide()
    for handlers, handler in ((bpy.app.handlers.depsgraph_update_post, _on_change),
                              (bpy.app.handlers.load_pre, _on_load)):
        if handler in handlers:
            handlers.remove(handler)
    if bpy.app.timers.is_registered(_tick):
        bpy.app.timers.unregister(_tick)
