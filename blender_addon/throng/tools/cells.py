# SPDX-License-Identifier: Apache-2.0
"""The bake's diagram images on the ground: as an overlay that shows whose ground is whose, or as a mask in
the ground's own materials.

Image textures play them natively. A bake may have an image every so many frames only; then the texture's frame offset
is keyed, so that each stays until the next, and a farm needs no add-on.
"""
import os

import bpy
from bpy.props import EnumProperty, FloatProperty

from ..blender.actions import curves_of
from ..blender.nodes import own_tree
from ..blender.panels import Below
from ..blender.paths import stored_path
from ..crowd.queries import ChangesCrowds, OnCrowds, bake_path, changed_crowds, collection_of
from ..environment.shapes import Shape
from ..environment.streets import MARK_Z
from ..formats import Bake, BakeError, read_manifest
from . import storey_cells

KINDS = ("overlay", "mask", "none")
OVERLAY, TRODDEN = "throng_cells", "throng trodden"  # a property of the overlay's object; the nodes that darken ground
# a collection's {kind, strength, lost}, while it has cells, or had until its bake lost its images
SHOWN = "throng_cells_shown"
_GROUNDS = ("Throng ground", "Throng terrain", "Throng road", "Throng area")
_ABOVE = 0.006  # m, over the road's markings
_DARKER = 0.3   # of its light, what is left of the ground within cells


def show(crowd, kind, strength):
    """Puts the crowd's cells on its ground, in place of what was there. Raises BakeError before anything is changed."""
    collection = collection_of(crowd)
    if not collection:
        raise BakeError("this crowd's collection is not its import's any more: import the bake again")
    if kind == "none":
        _take_away(collection)
        collection.pop(SHOWN, None)
        return
    path = bake_path(crowd)
    bake = Bake(read_manifest(path), os.path.dirname(path))
    diagrams = _diagrams(bake)
    if "storeys" in diagrams and not _terrain_in(collection):
        raise BakeError("this bake has levels, and their floors are not in the scene: import it with its ground")
    _take_away(collection)
    tree = _cells_tree(_tree_name(collection), bake, diagrams, crowd)
    if "storeys" in diagrams:
        material = _overlay_material(tree, strength) if kind == "overlay" else _darkening_material(tree, strength)
        collection.objects.link(_storeys(collection, bake, material))
    elif kind == "overlay":
        collection.objects.link(_overlay(collection, crowd, diagrams, _overlay_material(tree, strength)))
    else:
        for material in _own_grounds(collection):
            _tread(material, tree, strength)
    collection[SHOWN] = {"kind": kind, "strength": strength, "lost": False}


def follow(crowd):
    """Where a crowd's cells are shown, shows those of what it plays now. Without images they go, until it has some
    again; returns that, in sentences."""
    collection = collection_of(crowd)
    shown = collection.get(SHOWN) if collection else None
    if not shown:
        return []
    if shown["kind"] == "overlay" and not shown["lost"] and not any(OVERLAY in thing for thing in collection.objects):
        del collection[SHOWN]  # removed by hand
        return []
    try:
        show(crowd, shown["kind"], shown["strength"])
    except BakeError as error:
        _take_away(collection)
        shown["lost"] = True
        return [f"{crowd.name}: no cells on the ground any more: {error}"]
    return []


def _diagrams(bake):
    """The manifest's entry, with its files known to be there."""
    diagrams = bake.manifest.get("diagrams")
    if not diagrams:
        raise BakeError("this bake has no diagram images: bake it with --diagrams")
    for frame in range(0, diagrams["count"] * diagrams["every"], diagrams["every"]):
        if not os.path.exists(_file(bake, frame)):
            raise BakeError(f"{os.path.basename(_file(bake, frame))} is missing: copy the whole bake "
                            "folder, or bake it again")
    return diagrams


def _file(bake, frame):
    return os.path.join(bake.folder, "diagrams", f"diagram.{frame + 1:04d}.exr")


def _take_away(collection):
    _remove_overlays(collection)
    # Also where it is on nothing just now: streets that are built anew take their old materials again.
    own = {material for material in bpy.data.materials if material.get("throng_crowd") == collection.name}
    for material in {slot.material for slot in _ground_slots(collection)} | own:
        _untread(material)
    tree = own_tree(_tree_name(collection))
    if tree and tree.users == 0:  # an artist's materials may have it, too
        _remove_tree(tree)


def _remove_overlays(collection):
    for thing in [thing for thing in collection.objects if OVERLAY in thing]:
        bpy.data.objects.remove(thing)
    # Also of overlays that were removed by hand. On a terrain the mesh is the terrain's, and has materials of its own.
    bpy.data.batch_remove([mesh for mesh in bpy.data.meshes
                           if mesh.users == 0 and any(material and OVERLAY in material for material in mesh.materials)])
    bpy.data.batch_remove([material for material in bpy.data.materials if OVERLAY in material and material.users == 0])


def _tree_name(collection):
    return f"{collection.name} cells"


def _remove_tree(tree):
    images = {node.image for node in tree.nodes if node.type == "TEX_IMAGE" and node.image}
    action = tree.animation_data.action if tree.animation_data else None
    bpy.data.node_groups.remove(tree)
    bpy.data.batch_remove([each for each in (*images, action) if each and each.users == 0])


def _ground_slots(collection):
    """Material slots of what people walk on."""
    return [slot for thing in collection.all_objects if thing.type == "MESH" and thing.name.startswith(_GROUNDS)
            for slot in thing.material_slots if slot.material and slot.material.use_nodes]


def _own_grounds(collection):
    """Their materials, each once; of this crowd alone from now on, for its cells are."""
    own = {material["throng_of"]: material for material in bpy.data.materials
           if material.get("throng_crowd") == collection.name}
    for slot in _ground_slots(collection):
        if slot.material.get("throng_crowd") != collection.name:
            name = slot.material.name
            if name not in own:
                own[name] = slot.material.copy()
                own[name]["throng_crowd"], own[name]["throng_of"] = collection.name, name
            slot.material = own[name]
    return list({slot.material for slot in _ground_slots(collection)})


def _cells_tree(name, bake, diagrams, crowd):
    """Colour and mask of the cells, as a group of nodes for any material, whatever it is on."""
    tree = own_tree(name)
    if tree:
        tree.nodes.clear()
        tree.animation_data_clear()
    else:
        tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
        for output, kind in (("Colour", "NodeSocketColor"), ("Mask", "NodeSocketFloat")):
            if hasattr(tree, "interface"):
                tree.interface.new_socket(name=output, in_out="OUTPUT", socket_type=kind)
            else:
                tree.outputs.new(kind, output)
    at = _place_in_storeys(tree) if "storeys" in diagrams else _place_in_plan(tree, diagrams, crowd)
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.name, texture.extension = "cells", "CLIP"
    texture.image = _sequence(bake, crowd.modifiers["throng pos"].filepath.startswith("//"))
    _play(tree, texture.image_user, diagrams, int(crowd.modifiers["throng pos"].frame_start))
    out = tree.nodes.new("NodeGroupOutput")
    for a, b in ((at, texture.inputs[0]), (texture.outputs["Color"], out.inputs["Colour"]),
                 (texture.outputs["Alpha"], out.inputs["Mask"])):
        tree.links.new(a, b)
    return tree


def _place_in_plan(tree, diagrams, crowd):
    """Where a point is in the image, seen from above."""
    place = tree.nodes.new("ShaderNodeTexCoord")
    place.object = crowd  # metres in the bake's own frame
    fit = tree.nodes.new("ShaderNodeMapping")
    size = [diagrams[side] / diagrams["pixels_per_metre"] for side in ("width", "height")]
    fit.inputs["Location"].default_value = (-diagrams["min"][0] / size[0], -diagrams["min"][1] / size[1], 0.0)
    fit.inputs["Scale"].default_value = (1.0 / size[0], 1.0 / size[1], 0.0)
    tree.links.new(place.outputs["Object"], fit.inputs["Vector"])
    return fit.outputs[0]


def _place_in_storeys(tree):
    """The same where people walk above people: the mesh knows."""
    place = tree.nodes.new("ShaderNodeAttribute")
    place.attribute_name = storey_cells.AT
    return place.outputs["Vector"]


def _sequence(bake, relative):
    path = _file(bake, 0)
    image = bpy.data.images.load(path, check_existing=True)
    image.source = "SEQUENCE"
    image.filepath = stored_path(path, relative)
    image.reload()  # it may have been baked again
    return image


def _play(tree, user, diagrams, start):
    """Files are numbered by the bake's frames from 1 on. With a duration of 1, Blender shows file 1 + the offset
    whatever the frame is."""
    every, count = diagrams["every"], diagrams["count"]
    user.use_auto_refresh = True
    if every == 1:
        user.frame_start, user.frame_duration, user.frame_offset = start, count, 0
        return
    user.frame_start, user.frame_duration = start, 1
    for i in range(count):
        user.frame_offset = i * every
        tree.keyframe_insert('nodes["cells"].image_user.frame_offset', frame=start + i * every)
    for curve in curves_of(tree.animation_data.action):
        for key in curve.keyframe_points:
            key.interpolation = "CONSTANT"


def _bare_material():
    """Without nodes, for what lies above the ground."""
    material = bpy.data.materials.new("throng cells")
    material[OVERLAY] = True  # who puts another in its place keeps that
    material.use_nodes = True
    if hasattr(material, "blend_method"):
        material.blend_method = "BLEND"
    material.node_tree.nodes.clear()
    return material


def _group_and_share(nodes, tree, strength):
    group = nodes.new("ShaderNodeGroup")
    group.node_tree = tree
    share = nodes.new("ShaderNodeMath")
    share.operation, share.inputs[1].default_value = "MULTIPLY", strength
    return group, share


def _overlay_material(tree, strength):
    """The cells shine."""
    material = _bare_material()
    nodes, links = material.node_tree.nodes, material.node_tree.links
    group, share = _group_and_share(nodes, tree, strength)
    see, shine, mix, out = (nodes.new(f"ShaderNode{kind}")
                            for kind in ("BsdfTransparent", "Emission", "MixShader", "OutputMaterial"))
    for a, b in ((group.outputs["Mask"], share.inputs[0]), (group.outputs["Colour"], shine.inputs["Color"]),
                 (share.outputs[0], mix.inputs[0]), (see.outputs[0], mix.inputs[1]), (shine.outputs[0], mix.inputs[2]),
                 (mix.outputs[0], out.inputs["Surface"])):
        links.new(a, b)
    return material


def _darkening_material(tree, strength):
    """What is below is darker in cells, as if it were trodden or wet."""
    material = _bare_material()
    nodes, links = material.node_tree.nodes, material.node_tree.links
    group, share = _group_and_share(nodes, tree, strength)
    mix, see, out = (nodes.new(f"ShaderNode{kind}") for kind in ("MixRGB", "BsdfTransparent", "OutputMaterial"))
    mix.inputs[1].default_value, mix.inputs[2].default_value = (1.0, 1.0, 1.0, 1.0), (_DARKER, _DARKER, _DARKER, 1.0)
    for a, b in ((group.outputs["Mask"], share.inputs[0]), (share.outputs[0], mix.inputs[0]),
                 (mix.outputs[0], see.inputs["Color"]), (see.outputs[0], out.inputs["Surface"])):
        links.new(a, b)
    return material


def _storeys(collection, bake, material):
    """Cells a little above the ground of each storey."""
    ground = _terrain_in(collection)
    mesh = storey_cells.build(ground, bake.manifest["diagrams"], bake.manifest, 2.0 * _ABOVE)
    mesh.materials.append(material)
    thing = bpy.data.objects.new("Throng cells", mesh)
    thing.matrix_world = ground.matrix_world
    thing[OVERLAY] = True
    thing.visible_shadow = False
    return thing


def _terrain_in(collection):
    return next((thing for thing in collection.objects if thing.name.startswith("Throng terrain")), None)


def _overlay(collection, crowd, diagrams, material):
    """Cells a little above the ground: on the terrain's own mesh, or on a plane."""
    ground = _terrain_in(collection)
    if ground:
        plane = bpy.data.objects.new("Throng cells", ground.data)
        plane.matrix_world = ground.matrix_world
        plane.location.z += 2.0 * _ABOVE
        for slot in plane.material_slots:
            slot.link, slot.material = "OBJECT", material
    else:
        low = diagrams["min"]
        high = [low[axis] + diagrams[side] / diagrams["pixels_per_metre"]
                for axis, side in enumerate(("width", "height"))]
        shape = Shape("Throng cells")
        shape.flat([(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])], MARK_Z + _ABOVE,
                   material)
        plane = shape.to_object()
        plane.parent = crowd  # wherever that is: a drawn layout may have another origin than its bake
    plane[OVERLAY] = True
    plane.visible_shadow = False
    return plane


def _tread(material, tree, strength):
    """Darkens a ground material where people are, as if it were trodden or wet."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next((node for node in nodes if node.type == "BSDF_PRINCIPLED"), None)
    if not shader:
        return
    group, share = _group_and_share(nodes, tree, strength)
    darker = nodes.new("ShaderNodeHueSaturation")
    for node in (group, share, darker):
        node.name = TRODDEN
    darker.inputs["Value"].default_value = _DARKER
    colour = shader.inputs["Base Color"]
    darker.inputs["Color"].default_value = colour.default_value
    if colour.links:
        links.new(colour.links[0].from_socket, darker.inputs["Color"])
    links.new(group.outputs["Mask"], share.inputs[0])
    links.new(share.outputs[0], darker.inputs["Fac"])
    links.new(darker.outputs[0], colour)


def _untread(material):
    """Undoes _tread(): the colour goes where it went before."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    for node in [node for node in nodes if node.name.startswith(TRODDEN)]:
        if node.type == "HUE_SAT" and node.inputs["Color"].links:
            source = node.inputs["Color"].links[0].from_socket
            for target in [link.to_socket for link in node.outputs[0].links]:
                links.new(source, target)
        nodes.remove(node)


class THRONG_OT_cells(ChangesCrowds, bpy.types.Operator):
    """Show the bake's diagram images on the ground: whose ground is whose, or a mask where people are"""

    bl_idname = "throng.cells"
    bl_label = "Cells on the Ground"
    bl_options = {"REGISTER", "UNDO"}

    kind: EnumProperty(name="As",
                       items=[("overlay", "Overlay", "Everybody's cell in a colour of its own, over the ground"),
                              ("mask", "Ground Mask", "The ground's materials are darker where people are"),
                              ("none", "Nothing", "As it was before")])
    strength: FloatProperty(name="Strength", default=0.6, min=0.0, max=1.0,
                            description="How opaque the cells are, or how much darker the ground is")

    def execute(self, context):
        try:
            for crowd in changed_crowds(context):
                show(crowd, self.kind, self.strength)
        except BakeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class VIEW3D_PT_throng_cells(OnCrowds, Below, bpy.types.Panel):
    bl_label = "Cells on the Ground"

    def draw(self, _context):
        row = self.layout.row(align=True)
        for kind, text in zip(KINDS, ("Overlay", "Ground Mask", "Nothing")):
            row.operator(THRONG_OT_cells.bl_idname, text=text).kind = kind


CLASSES = (THRONG_OT_cells, VIEW3D_PT_throng_cells)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
