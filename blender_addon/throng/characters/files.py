# SPDX-License-Identifier: Apache-2.0
"""glTF files: read into the scene for a moment, and everything that is not needed taken out again."""
import json
import os
import struct
from contextlib import contextmanager

import bpy
import numpy

from . import CharacterError

_KINDS = ("objects", "actions", "armatures", "meshes", "collections", "cameras", "lights", "curves", "scenes", "worlds",
          "shape_keys", "materials", "images", "node_groups", "textures")


def check(path):
    """Raises CharacterError unless the file begins as a glTF does."""
    name = os.path.basename(path)
    try:
        with open(path, "rb") as file:
            head = file.read(20)
            if head[:4] == b"glTF":
                length = struct.unpack("<I", head[8:12])[0] if len(head) >= 12 else 0
                if length != os.path.getsize(path):
                    raise CharacterError(f"{name} is truncated: it should have {length} bytes, and "
                                         f"has {os.path.getsize(path)}")
                return
            document = json.loads(head + file.read())
    except OSError as error:
        raise CharacterError(f"{name} cannot be read: {error.strerror}") from None
    except ValueError:
        raise CharacterError(f"{name} is not a glTF file: choose a .glb or .gltf") from None
    if not isinstance(document, dict) or "asset" not in document:
        raise CharacterError(f"{name} is JSON, but not glTF: it has no `asset`")


def _everything():
    return {kind: set(getattr(bpy.data, kind)) for kind in _KINDS if hasattr(bpy.data, kind)}


@contextmanager
def imported(context, path):
    """The armature of a glTF file. What the file brought is gone afterwards, but for materials and images that
    something else uses by then."""
    check(path)
    if not hasattr(bpy.types, "IMPORT_SCENE_OT_gltf"):
        raise CharacterError("Blender's own add-on for glTF 2.0 is switched off: enable it in the preferences")
    if "bool" not in vars(numpy):
        numpy.bool = bool  # Blender 3.4's importer asks for it, NumPy from 1.24 has it no more
    scene, before = context.scene, _everything()
    kept = (scene.frame_start, scene.frame_end, scene.frame_current, scene.render.fps, scene.render.fps_base,
            scene.camera, scene.world)
    active = context.view_layer.objects.active
    selected = [thing for thing in context.view_layer.objects if thing.select_get()]
    brought = {}
    try:
        try:
            bpy.ops.import_scene.gltf(filepath=path)
        except Exception as error:  # the importer fails in many ways on broken files
            reason = str(error).strip().splitlines()[-1] if str(error).strip() else type(error).__name__
            raise CharacterError(f"{os.path.basename(path)} cannot be imported: {reason}") from None
        finally:
            brought = {kind: set(getattr(bpy.data, kind)) - known for kind, known in before.items()}
        armatures = [thing for thing in brought["objects"] if thing.type == "ARMATURE"]
        if not armatures:
            raise CharacterError(f"{os.path.basename(path)} has no skeleton: a character needs a skin with joints")
        yield max(armatures, key=_weight)
    finally:
        (scene.frame_start, scene.frame_end, scene.frame_current, scene.render.fps, scene.render.fps_base, scene.camera,
         scene.world) = kept
        _take_out(brought)
        for thing in selected:
            thing.select_set(True)
        context.view_layer.objects.active = active


def _weight(armature):
    return sum(len(thing.data.vertices) for thing in armature.children_recursive if thing.type == "MESH")


def _take_out(brought):
    """Removes what a file brought, except meshes' materials and their images where pose meshes use them by now."""
    for kind in ("scenes", "objects", "collections", "cameras", "lights", "curves", "worlds", "actions", "meshes",
                 "armatures"):
        bpy.data.batch_remove(list(brought.get(kind, ())))
    for kind in ("materials", "node_groups", "textures", "images"):
        for each in brought.get(kind, ()):
            if each.users == 0:
                getattr(bpy.data, kind).remove(each)


def pack_images(meshes):
    """Images of these meshes go into the .blend, unless they lie beside it."""
    seen = set()
    queue = [material.node_tree for mesh in meshes for material in mesh.materials if material and material.node_tree]
    while queue:
        tree = queue.pop()
        if tree in seen:
            continue
        seen.add(tree)
        for node in tree.nodes:
            if node.type == "GROUP" and node.node_tree:
                queue.append(node.node_tree)
            image = getattr(node, "image", None)
            if image and image.source == "FILE" and not image.packed_file and not image.filepath.startswith("//"):
                try:
                    image.pack()
                except RuntimeError:
                    raise CharacterError(f"the image {image.name} cannot be read: {image.filepath}") from None
