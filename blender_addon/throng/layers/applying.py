# SPDX-License-Identifier: Apache-2.0
"""A crowd's layers: kept in its scene, written into the file of overrides, applied, and shown beside the crowd."""
import json
import os
import subprocess

import bpy

from ..authoring.bake_job import parse_diagnostics
from ..authoring.executable import ExecutableError, check_version, find_executable
from ..authoring.preferences import program
from ..crowd.queries import LAYERED_OF, crowd_objects
from ..formats import BakeError
from ..overrides import layer as overrides
from ..overrides.merging import exclusive
from ..overrides.override_file import check_layers, read, read_layers, write
from ..tools.update import reload
from .wording import parsed

_KNOWN = "throng_layers_known"  # the file, and its layers when scene and file were last brought together
SUFFIX = ".layered"


class LayerError(BakeError):
    """Something is wrong with one layer: `index` says with which."""

    def __init__(self, message, index=None):
        super().__init__(message)
        self.index = index


def layers_of(crowd):
    """The scene's layers in the file's form. Raises LayerError."""
    layers = []
    for index, item in enumerate(crowd.throng_layers):
        try:
            made = {"name": item.name, "who": parsed(item.who, "Who"), "do": parsed(item.do, "What")}
        except ValueError as error:
            raise LayerError(f"{item.name}: {error}", index) from None
        if not item.enabled:
            made["enabled"] = False
        if item.note:
            made["note"] = item.note
        layers.append(made)
    return check_layers(layers, crowd.name)


def append(crowd, made):
    item = crowd.throng_layers.add()
    item.name, item.enabled, item.note = made["name"], made.get("enabled", True), made.get("note", "")
    item.who, item.do = (json.dumps(made[key], ensure_ascii=False) for key in ("who", "do"))
    crowd.throng_layer_index = len(crowd.throng_layers) - 1


def _note(crowd, path, layers):
    crowd[_KNOWN] = json.dumps([path, layers])


def _known(crowd, path):
    """What the scene knows of a file: nothing of one that it has not read, beside another bake, say."""
    noted, layers = json.loads(crowd.get(_KNOWN, '["", []]'))
    return layers if noted == path else []


def load(crowd):
    """Takes the file's layers instead of the scene's."""
    path = overrides.file_of(crowd)
    layers = read_layers(path)
    crowd.throng_layers.clear()
    for made in layers:
        append(crowd, made)
    _note(crowd, path, layers)


def load_once(crowd):
    """So that what is in the file is not lost for a scene that has never read it."""
    if _KNOWN not in crowd and not len(crowd.throng_layers):
        load(crowd)


def save(crowd):
    """Writes the scene's layers into the file; returns its path. What somebody else has written there meanwhile is not
    overwritten."""
    layers, path = layers_of(crowd), overrides.file_of(crowd)
    with exclusive(path):
        theirs = read_layers(path)
        if theirs not in (_known(crowd, path), layers):
            raise BakeError(f"{path}: somebody else has changed the layers, so nothing is written: Re-load Layers "
                            "shows what they did")
        if theirs != layers or not os.path.exists(path):
            write(path, read(path) if os.path.exists(path) else overrides.entries_of(crowd), layers)
    _note(crowd, path, layers)
    return path


def _run(context, arguments):
    try:
        executable = find_executable(program(context))
        check_version(executable)
    except ExecutableError as error:
        raise BakeError(str(error)) from None
    return subprocess.run([executable, *arguments], capture_output=True, text=True, errors="replace", check=False)


def _failure(said):
    """What the program says, with the layer that it is about."""
    wrong = [entry for entry in parse_diagnostics(said) if entry.severity == "error"]
    if not wrong:
        lines = [line for line in said.splitlines() if line.strip()]
        return BakeError(lines[-1].removeprefix("throng: ") if lines else "throng apply has failed and says nothing")
    parts = wrong[0].pointer.split("/")
    index = int(parts[2]) if len(parts) > 2 and parts[1] == "layers" and parts[2].isdigit() else None
    hint = f" ({wrong[0].hint})" if wrong[0].hint else ""
    return LayerError(f"{'/'.join(parts[3:])}: {wrong[0].message}{hint}", index)


def apply(context, crowd):
    """Writes the layers, applies them and shows what comes of it. Returns (what `throng apply` prints, remarks)."""
    path, bake = save(crowd), os.path.dirname(overrides.bake_path(crowd))
    output = bake.rstrip(os.sep) + SUFFIX
    done = _run(context, ["apply", bake, "--overrides", path, "-o", output, "--force", "--gltf", "no", "-q"])
    if done.returncode:
        raise _failure(done.stderr)
    show(context, crowd, os.path.join(output, "bake.json"))
    remarks = [line.removeprefix("throng: ") for line in done.stderr.splitlines() if line.startswith("throng: ")]
    return done.stdout.splitlines()[1:], remarks


def layered_crowd(scene, crowd):
    """The crowd that shows what a crowd's layers make of it; None where there is none."""
    return next((each for each in crowd_objects(scene) if each.get(LAYERED_OF) == crowd), None)


def show(context, crowd, path):
    """Plays the bake with the layers in a crowd that shares the cast; the one without them is hidden."""
    made = layered_crowd(context.scene, crowd)
    if made is None:
        made = _twin(context.scene, crowd)
        try:
            reload(made, context.scene, path)
        except BakeError:
            mesh = made.data
            bpy.data.objects.remove(made)
            bpy.data.meshes.remove(mesh)
            raise
    else:
        reload(made, context.scene, path)
    compare(context.scene, crowd, True)


def _twin(scene, crowd):
    made = crowd.copy()
    made.data = crowd.data.copy()
    made.name = f"{crowd.name} layered"
    made[LAYERED_OF] = crowd
    made.throng_overrides.clear()  # they are in the bake that it will play
    made.throng_layers.clear()
    made.pop(_KNOWN, None)
    collection = bpy.data.collections.new(made.name)
    collection["throng_bake"] = overrides.bake_path(crowd)
    collection["throng_origin"] = list(overrides.bake_of(crowd).origin)
    scene.collection.children.link(collection)
    collection.objects.link(made)
    return made


def compare(scene, crowd, with_layers):
    """Shows one of the two crowds."""
    made = layered_crowd(scene, crowd)
    for thing, shown in ((crowd, not with_layers or made is None), (made, with_layers)):
        if thing is not None:
            thing.hide_viewport = thing.hide_render = not shown
