# SPDX-License-Identifier: Apache-2.0
"""Baking the scene's layout: in the background while one goes on working, or at once in a Blender without windows."""
import os
import shutil
import tempfile
import time

import bpy
from bpy.props import IntProperty

from ..blender.polls import available, in_object_mode
from ..formats import BakeError
from ..formats.outcomes import account_text
from .bake_job import BakeJob, Diagnostic, check_layout
from .executable import ExecutableError, check_version, find_executable
from .exporter import default_name, export_layout, folder_of_files, layout_text, write_text
from .geometry import AuthoringError
from .load import load
from .operators import refused, select_only
from .preferences import program

_running = {}  # the bake under way, if there is one: "bake"


def running():
    """The bake under way, or None."""
    return _running.get("bake")


_ACTIVE = {"flows": "active_flow", "events": "active_event", "behaviours": "active_behaviour", "given": "active_given",
           "shows": "active_show"}


def _section(pointer):
    """The first two parts of a JSON pointer: what of the layout it is about."""
    return "/".join(pointer.split("/")[:3])


def remembered(sources):
    """Sources by name: undo and deletion make references to objects invalid."""
    return {pointer: (thing.name if thing else "", where, index) for pointer, (thing, where, index) in sources.items()}


def list_problems(context, diagnostics, sources):
    """Lists what was said about the layout. `sources` by name."""
    layout = context.scene.throng_layout
    layout.problems.clear()
    for entry in diagnostics:
        problem = layout.problems.add()
        problem.message, problem.hint, problem.pointer = entry.message, entry.hint, entry.pointer
        problem.is_error = entry.severity == "error"
        name, problem.where, problem.index = sources.get(_section(entry.pointer), ("", "", -1))
        problem.target = bpy.data.objects.get(name) if name else None


def show_problems(context, diagnostics, sources):
    """The same, and selects what the first error is about."""
    list_problems(context, diagnostics, sources)
    layout = context.scene.throng_layout
    first = next((problem for problem in layout.problems if problem.is_error), None)
    if first:
        show(context, first)


def described(layout, problem):
    """A problem with the name of what it is about."""
    owner = ""
    if problem.target:
        owner = problem.target.name
    elif problem.where in ("flows", "behaviours", "given") and problem.index < len(getattr(layout, problem.where)):
        owner = getattr(layout, problem.where)[problem.index].name
    about = " ".join([owner] + problem.pointer.split("/")[3:]).strip()
    return f"{about}: {problem.message}" if about else problem.message


def show(context, problem):
    """Selects what a problem is about."""
    layout = context.scene.throng_layout
    if problem.target:
        select_only(context, problem.target)
    elif problem.where:
        setattr(layout, _ACTIVE[problem.where], problem.index)


def _complain(context, message, target=None, pointer=""):
    layout = context.scene.throng_layout
    layout.problems.clear()
    problem = layout.problems.add()
    problem.message, problem.target, problem.pointer = message, target, pointer


_UNCHOSEN = (("from", "choose where people come from"), ("to", "choose where people go"))


def _unchosen(document):
    """Flows without a place: what an artist forgets, said in the panel's words."""
    missing = [(f"/flows/{index}/{key}", message, "a road's end or an area")
               for index, flow in enumerate(document.get("flows", [])) for key, message in _UNCHOSEN
               if flow.get(key) == ""]
    missing += [(f"/flows/{index}/to", "choose to which seats people go", "a block of seats")
                for index, flow in enumerate(document.get("flows", []))
                if isinstance(flow.get("to"), dict) and flow["to"].get("seats") in ("", [], [""])]
    missing += [(f"/seats/{index}/leave/to", _UNCHOSEN[1][1], "a road's end or an area")
                for index, block in enumerate(document.get("seats", []))
                if isinstance(block.get("leave"), dict) and block["leave"].get("to") == ""]
    return [Diagnostic("error", pointer, message, hint, 0, 0) for pointer, message, hint in missing]


class LayoutFile:
    """The scene's layout in a file that is gone afterwards: beside the files that it names, if it names
    any. Raises AuthoringError.

    diagnostics: what is wrong with it already.
    """

    def __init__(self, context, hidden_name=".throng"):
        document, sources = export_layout(context)
        document.setdefault("name", default_name(context.scene))
        self.sources = remembered(sources)
        self.diagnostics = _unchosen(document)
        self.own_meshes = [int(pointer.split("/")[2]) for pointer, (thing, _, _) in sources.items()
                           if pointer.startswith("/walls/") and thing.type == "MESH"]
        beside = folder_of_files(context.scene, document)
        self.folder = None if beside else tempfile.mkdtemp(prefix="throng-")
        name = "layout.json" if self.folder else f"{hidden_name}-{os.getpid()}.json"
        self.path = os.path.join(self.folder or beside, name)
        try:
            write_text(self.path, layout_text(document))
        except AuthoringError:
            self.remove()
            raise

    def remove(self):
        if self.folder:
            shutil.rmtree(self.folder, ignore_errors=True)
        elif os.path.exists(self.path):
            os.unlink(self.path)


def _point_out(operator, context, file):
    """What is wrong with a layout before `throng` has seen it."""
    file.remove()
    show_problems(context, file.diagnostics, file.sources)
    layout = context.scene.throng_layout
    operator.report({"ERROR"}, described(layout, layout.problems[0]))
    return {"CANCELLED"}


def _output(scene):
    folder = scene.throng_layout.folder
    if folder.startswith("//") and not bpy.data.filepath:
        raise AuthoringError("save the .blend first: bakes are written beside it (or choose another folder)")
    return os.path.join(os.path.abspath(bpy.path.abspath(folder)), default_name(scene))


def program_path(context):
    """Of the `throng` that is run. Raises ExecutableError."""
    path = find_executable(program(context))
    check_version(path)
    return path


class Bake:
    """One bake of a scene: from its layout's file to its crowd. Raises AuthoringError or ExecutableError
    when it cannot begin."""

    def __init__(self, context, file):
        scene = context.scene
        self.scene_name, self.file = scene.name, file
        try:
            executable, output = program_path(context), _output(scene)
        except (AuthoringError, ExecutableError):
            file.remove()
            raise
        self.made_folder = not os.path.isdir(os.path.dirname(output))
        self.job = BakeJob(executable, self.file.path, output, ("--feet", "--attention"))
        self.start = time.monotonic()
        _running["bake"] = self
        self.job.start()

    def tick(self, context):
        """Whether it is still going on; tells the scene how far it is."""
        state = self.job.poll()
        layout = context.scene.throng_layout
        layout.progress = self.job.percent
        layout.status = self._status()
        return state == "running"

    def _status(self):
        job = self.job
        if not job.frames:
            return "Setting up"
        left = "" if job.seconds_left is None or job.frame < 2 else f", {job.seconds_left:.0f} s left"
        return f"Frame {job.frame} of {job.frames}: {job.people} people{left}"

    def cancel(self):
        self.job.cancel()

    def abandon(self):
        """When nobody is there any more to load the result."""
        self.job.stop()
        self._close()

    def _close(self):
        self.file.remove()
        _running.pop("bake", None)
        if self.made_folder and self.job.state != "done":
            try:
                os.rmdir(os.path.dirname(self.job.output))
            except OSError:
                pass  # something is in it by now, or it was never made

    def finish(self, context):
        """Loads what was baked, or shows what was wrong. Returns (level, message) to report."""
        self._close()
        scene = bpy.data.scenes.get(self.scene_name)
        if scene is None:
            return "WARNING", f"The scene is gone; its bake is {self.job.output}"
        if scene != context.scene:
            with context.temp_override(scene=scene, view_layer=scene.view_layers[0]):
                return self._end(bpy.context)
        return self._end(context)

    def _end(self, context):
        layout, job = context.scene.throng_layout, self.job
        layout.status, layout.progress = "", 0.0
        show_problems(context, job.diagnostics, self.file.sources)
        if job.state == "cancelled":
            return "WARNING", "The bake was cancelled; nothing was written"
        if job.state != "done":
            return "ERROR", self._first_error(layout)
        try:
            lost = load(context, os.path.join(job.output, "bake.json"), self.file.own_meshes)
        except BakeError as error:
            layout.problems.add().message = str(error)
            return "ERROR", str(error)
        account = job.result["account"]
        refused = account.get("refused_reasons", {}).items()
        self._warn(layout, [f"{count} people are not in the crowd: {reason}" for reason, count in refused] + lost)
        seconds = time.monotonic() - self.start
        return "INFO", f"{account_text(account)}; {job.result['frames']} frames in {seconds:.1f} s"

    def _first_error(self, layout):
        errors = [problem for problem in layout.problems if problem.is_error]
        if not errors:
            layout.problems.add().message = self.job.message
            return self.job.message
        return described(layout, errors[0]) + (f" (and {len(errors) - 1} more)" if len(errors) > 1 else "")

    @staticmethod
    def _warn(layout, lines):
        for line in lines:
            problem = layout.problems.add()
            problem.message, problem.is_error = line, False


class THRONG_OT_bake(bpy.types.Operator):
    """Bake the layout and load the crowd; goes on in the background. Esc cancels"""

    bl_idname = "throng.bake"
    bl_label = "Bake"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        return in_object_mode(cls, context) and available(
            cls, "A bake is going on: wait for its end, or cancel it first" if running() else "")

    def _begin(self, context):
        context.scene.throng_layout.problems.clear()
        try:
            file = LayoutFile(context)
            if file.diagnostics:
                return _point_out(self, context, file)
            self.bake = Bake(context, file)
        except (AuthoringError, ExecutableError) as error:
            _complain(context, str(error), getattr(error, "target", None))
            return refused(self, error)
        return None

    def execute(self, context):
        begun = self._begin(context)
        if begun:
            return begun
        while self.bake.tick(context):
            time.sleep(0.02)
        return self._finish(context)

    def invoke(self, context, _event):
        if bpy.app.background:
            return self.execute(context)
        begun = self._begin(context)
        if begun:
            return begun
        manager = context.window_manager
        self.timer = manager.event_timer_add(0.2, window=context.window)
        manager.progress_begin(0.0, 100.0)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self.bake.cancel()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        going_on = self.bake.tick(context)
        context.window_manager.progress_update(self.bake.job.percent)
        if context.workspace:
            status = f"Throng: {context.scene.throng_layout.status} ({self.bake.job.percent:.0f} %)   Esc: cancel"
            context.workspace.status_text_set(status if going_on else None)
        for area in context.screen.areas if context.screen else ():
            if area.type == "VIEW_3D":
                area.tag_redraw()
        if going_on:
            return {"PASS_THROUGH"}
        self._end_modal(context)
        return self._finish(context)

    def _end_modal(self, context):
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()

    def cancel(self, context):
        """Blender closes, or opens another file."""
        self._end_modal(context)
        self.bake.abandon()

    def _finish(self, context):
        level, message = self.bake.finish(context)
        self.report({level}, message)
        return {"FINISHED"} if level == "INFO" else {"CANCELLED"}


class THRONG_OT_bake_cancel(bpy.types.Operator):
    """Stop the bake; nothing of it is kept"""

    bl_idname = "throng.bake_cancel"
    bl_label = "Cancel Bake"

    @classmethod
    def poll(cls, _context):
        return available(cls, "" if running() else "No bake is going on")

    def execute(self, _context):
        running().cancel()
        return {"FINISHED"}


class THRONG_OT_check(bpy.types.Operator):
    """Say what is wrong with the layout, without baking it"""

    bl_idname = "throng.check"
    bl_label = "Check"

    def execute(self, context):
        try:
            executable = program_path(context)
            file = LayoutFile(context)
        except (AuthoringError, ExecutableError) as error:
            _complain(context, str(error), getattr(error, "target", None))
            return refused(self, error)
        if file.diagnostics:
            return _point_out(self, context, file)
        try:
            valid, diagnostics, said = check_layout(executable, file.path)
        finally:
            file.remove()
        show_problems(context, diagnostics, file.sources)
        if valid:
            self.report({"INFO"}, said.splitlines()[-1].partition(": ok: ")[2] or said)
            return {"FINISHED"}
        layout = context.scene.throng_layout
        first = next((problem for problem in layout.problems if problem.is_error), None)
        self.report({"ERROR"}, described(layout, first) if first else said)
        return {"CANCELLED"}


class THRONG_OT_show_problem(bpy.types.Operator):
    """Select what this is about"""

    bl_idname = "throng.show_problem"
    bl_label = "Show"
    index: IntProperty()

    def execute(self, context):
        problems = context.scene.throng_layout.problems
        if not 0 <= self.index < len(problems):
            return {"CANCELLED"}
        show(context, problems[self.index])
        return {"FINISHED"}


CLASSES = (THRONG_OT_bake, THRONG_OT_bake_cancel, THRONG_OT_check, THRONG_OT_show_problem)

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(CLASSES)


def register():
    _register_classes()


def unregister():
    if running():
        running().abandon()
    _unregister_classes()
