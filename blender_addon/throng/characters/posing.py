# SPDX-License-Identifier: Apache-2.0
"""Pose meshes: what a character's meshes look like when its bones are where a pose wants them.

A puppet (a copy of the armature without constraints and drivers, with copies of the meshes) takes the poses, so that
all modifiers work as they do in the original, and each pose is one mesh of everything. Coarser levels of detail are
decimated before they are posed: all poses of a level have the same vertices and faces, so nothing crawls.
"""
import bmesh
import bpy
import numpy
from mathutils import Matrix

from ..cast.sheets import drop_spare_attributes
from . import CharacterError
from .rig import bone_above, is_skinned

LEVELS = (1.0, 1.0 / 3.0, 1.0 / 10.0)  # shares of the triangles, of the cast's levels of detail


class Puppet:
    def __init__(self, rig, stage, placement):
        self.stage = stage
        self.scene = bpy.data.scenes.new("throng puppet")
        armature = rig.armature
        self.armature = armature.copy()
        self.armature.data = armature.data.copy()
        self.armature.animation_data_clear()
        self.armature.data.animation_data_clear()
        self.armature.parent = None
        self.armature.constraints.clear()
        self.armature.data.pose_position = "POSE"
        self.world = placement @ numpy.array(armature.matrix_world)
        self.armature.matrix_world = Matrix(self.world)
        self.scene.collection.objects.link(self.armature)
        for bone in self.armature.pose.bones:
            for constraint in list(bone.constraints):
                bone.constraints.remove(constraint)
            bone.rotation_mode = "QUATERNION"
        for bone in self.armature.data.bones:
            bone.use_inherit_rotation, bone.use_local_location, bone.inherit_scale = True, True, "FULL"
        self.levels = [[self._copy(thing, armature, share) for thing in rig.meshes] for share in LEVELS]
        self.counts = [None] * len(LEVELS)
        self.templates = [None] * len(LEVELS)
        self.inverse = numpy.linalg.inv(self.world)
        self.rest = stage.rest
        self.above = numpy.array([numpy.linalg.inv(self.rest[parent]) @ self.rest[bone] if parent >= 0
                                  else self.rest[bone] for bone, parent in enumerate(stage.parents)])

    def _copy(self, thing, armature, share):
        twin = thing.copy()
        twin.data = self._decimated(thing, share) if share < 1.0 else thing.data.copy()
        twin.animation_data_clear()
        twin.constraints.clear()
        for modifier in twin.modifiers:
            if modifier.type == "ARMATURE" and modifier.object == armature:
                modifier.object = self.armature
                modifier.show_viewport = True
        twin.parent, twin.matrix_parent_inverse = self.armature, Matrix.Identity(4)
        bone = self.armature.data.bones.get(bone_above(thing, armature))
        resting = Matrix(self.stage.resting[thing])
        if bone and not is_skinned(thing, armature):
            twin.parent_type, twin.parent_bone = "BONE", bone.name
            resting = (bone.matrix_local @ Matrix.Translation((0.0, bone.length, 0.0))).inverted() @ resting
        else:
            twin.parent_type = "OBJECT"
        twin.matrix_basis = resting
        twin.hide_viewport = twin.hide_render = False
        self.scene.collection.objects.link(twin)
        return twin

    def _decimated(self, thing, share):
        """A mesh of fewer triangles, its vertex groups kept."""
        helper = thing.copy()
        helper.data = thing.data.copy()
        helper.modifiers.clear()
        helper.animation_data_clear()
        if helper.data.shape_keys:
            helper.shape_key_clear()
        modifier = helper.modifiers.new("throng detail", "DECIMATE")
        modifier.ratio = share
        self.scene.collection.objects.link(helper)
        layer = self.scene.view_layers[0]
        layer.update()
        mesh = bpy.data.meshes.new_from_object(helper.evaluated_get(layer.depsgraph), preserve_all_data_layers=True,
                                               depsgraph=layer.depsgraph)
        spare = helper.data
        bpy.data.objects.remove(helper)
        bpy.data.meshes.remove(spare)
        if hasattr(mesh, "free_normals_split"):
            mesh.free_normals_split()
        elif "custom_normal" in mesh.attributes:
            mesh.attributes.remove(mesh.attributes["custom_normal"])
        return mesh

    def pose(self, bones):
        """Puts the bones (B, 4, 4), in the walker's frame."""
        local = self.inverse @ bones
        parents = numpy.array(self.stage.parents)
        starts = numpy.where((parents >= 0)[:, None, None], local[parents] @ self.above, self.above)
        for name, basis in zip(self.stage.names, numpy.linalg.inv(starts) @ local):
            self.armature.pose.bones[name].matrix_basis = Matrix(basis)
        self.scene.view_layers[0].update()

    def points(self, level):
        """(V, 3): all vertices of a level as they are posed, in the walker's frame."""
        graph = self.scene.view_layers[0].depsgraph
        parts = []
        for thing in self.levels[level]:
            shown = thing.evaluated_get(graph)
            mesh = shown.to_mesh()
            flat = numpy.empty(3 * len(mesh.vertices), numpy.float32)
            mesh.vertices.foreach_get("co", flat)
            matrix = numpy.array(shown.matrix_world)
            parts.append(flat.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3])
            shown.to_mesh_clear()
        counts = [len(part) for part in parts]
        if self.counts[level] not in (None, counts):
            raise CharacterError("a modifier changes the number of vertices from pose to pose: apply it, or remove it")
        self.counts[level] = counts
        return numpy.concatenate(parts)

    def template(self, level, name):
        """A mesh of all parts of a level with their materials, texture coordinates and normals."""
        graph = self.scene.view_layers[0].depsgraph
        whole, materials = bmesh.new(), []
        customs = False
        for thing in self.levels[level]:
            shown = thing.evaluated_get(graph)
            part = bpy.data.meshes.new_from_object(shown, preserve_all_data_layers=True, depsgraph=graph)
            customs = customs or part.has_custom_normals
            slots = [slot.material for slot in shown.material_slots] or [None]
            for material in slots:
                original = material.original if material else None
                if original not in materials:
                    materials.append(original)
            places = [materials.index(material.original if material else None) for material in slots]
            flat = numpy.zeros(len(part.polygons), numpy.int32)
            part.polygons.foreach_get("material_index", flat)
            part.polygons.foreach_set("material_index",
                                      numpy.array(places, numpy.int32)[numpy.minimum(flat, len(places) - 1)])
            whole.from_mesh(part)
            bpy.data.meshes.remove(part)
        for layers in (whole.verts.layers.deform, whole.verts.layers.shape):  # of no use any more, and large
            for layer in layers.values():
                layers.remove(layer)
        mesh = bpy.data.meshes.new(name)
        whole.to_mesh(mesh)
        whole.free()
        for material in materials:
            mesh.materials.append(material)
        drop_spare_attributes(mesh, keep_sharp=True)
        if customs and hasattr(mesh, "use_auto_smooth"):
            mesh.use_auto_smooth = True
        return mesh

    def remove(self):
        things = [self.armature] + [thing for level in self.levels for thing in level]
        meshes = [thing.data for level in self.levels for thing in level]
        data = self.armature.data
        for thing in things:
            bpy.data.objects.remove(thing)
        for mesh in meshes:
            bpy.data.meshes.remove(mesh)
        bpy.data.armatures.remove(data)
        bpy.data.scenes.remove(self.scene)
