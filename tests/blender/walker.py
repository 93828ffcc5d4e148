# SPDX-License-Identifier: Apache-2.0
"""A rigged character of known proportions with clips of known strides. Runs inside Blender."""
import math

import bpy
from mathutils import Matrix, Vector

THIGH, SHIN, ANKLE, HALF_WIDTH = 0.45, 0.43, 0.08, 0.09  # m
HEEL, TOE = 0.07, 0.17
HEIGHT = 1.7


def _bones(turn):
    """{name: (head, tail, parent)}; the character looks along x before it is turned."""
    hip = ANKLE + THIGH + SHIN
    bones = {"pelvis": ((0, 0, hip), (0, 0, hip + 0.2), None), "torso": ((0, 0, hip + 0.2), (0, 0, 1.5), "pelvis"),
             "head": ((0, 0, 1.5), (0, 0, HEIGHT), "torso")}
    for side, y in (("R", -HALF_WIDTH), ("L", HALF_WIDTH)):
        knee = ANKLE + SHIN
        bones[f"thigh.{side}"] = ((0, y, hip), (0, y, knee), "pelvis")
        bones[f"shin.{side}"] = ((0, y, knee), (0, y, ANKLE), f"thigh.{side}")
        bones[f"end.{side}"] = ((0, y, ANKLE), (TOE, y, 0.0), f"shin.{side}")
        bones[f"arm.{side}"] = ((0, 2.4 * y, 1.45), (0, 2.4 * y, 0.9), "torso")
        bones[f"hand.{side}"] = ((0, 2.4 * y, 0.9), (0, 2.4 * y, 0.8), f"arm.{side}")
    return {name: (turn @ Vector(head), turn @ Vector(tail), parent) for name, (head, tail, parent) in bones.items()}


def _boxes():
    """Of each bone, the box (low, high) that it moves."""
    hip, w = ANKLE + THIGH + SHIN, 0.05
    boxes = {"pelvis": ((-0.09, -0.16, hip - 0.05), (0.09, 0.16, hip + 0.2)),
             "torso": ((-0.1, -0.18, hip + 0.2), (0.1, 0.18, 1.5)), "head": ((-0.09, -0.08, 1.5), (0.11, 0.08, HEIGHT))}
    for side, y in (("R", -HALF_WIDTH), ("L", HALF_WIDTH)):
        boxes[f"thigh.{side}"] = ((-w, y - w, ANKLE + SHIN), (w, y + w, hip))
        boxes[f"shin.{side}"] = ((-w, y - w, ANKLE), (w, y + w, ANKLE + SHIN))
        boxes[f"end.{side}"] = ((-HEEL, y - w, 0.0), (TOE, y + w, ANKLE))
        boxes[f"arm.{side}"] = ((-w, 2.4 * y - 0.04, 0.9), (w, 2.4 * y + 0.04, 1.45))
        boxes[f"hand.{side}"] = ((-w, 2.4 * y - 0.04, 0.8), (w, 2.4 * y + 0.04, 0.9))
    return boxes


def _box(low, high, turn, parts=4):
    """Vertices and faces of a box whose sides are divided, so that there is something to decimate."""
    vertices, faces = [], []
    low, high = Vector(low), Vector(high)
    for axis in range(3):
        a, b = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, 1):
            first = len(vertices)
            for i in range(parts + 1):
                for j in range(parts + 1):
                    share = Vector((0, 0, 0))
                    share[axis], share[a], share[b] = end, i / parts, j / parts
                    vertices.append(turn @ Vector(low[k] + (high[k] - low[k]) * share[k] for k in range(3)))
            for i in range(parts):
                for j in range(parts):
                    k = first + i * (parts + 1) + j
                    quad = (k, k + parts + 1, k + parts + 2, k + 1)
                    faces.append(quad if end else quad[::-1])
    return vertices, faces


def make(heading=180.0, name="Walker", scale=1.0):
    """The armature, its mesh (smooth, with a texture), and a stick in its hand; no clips yet.
    Looks that way, degrees."""
    turn = Matrix.Rotation(math.radians(heading), 3, "Z")
    data = bpy.data.armatures.new(name)
    armature = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(armature)
    bpy.context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    for bone_name, (head, tail, parent) in _bones(turn).items():
        bone = data.edit_bones.new(bone_name)
        bone.head, bone.tail = head * scale, tail * scale
        if parent:
            bone.parent = data.edit_bones[parent]
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = bpy.data.meshes.new(f"{name} body")
    vertices, faces, groups = [], [], {}
    for bone_name, (low, high) in _boxes().items():
        more, quads = _box(low, high, turn)
        groups[bone_name] = range(len(vertices), len(vertices) + len(more))
        faces += [tuple(len(vertices) + k for k in quad) for quad in quads]
        vertices += [v * scale for v in more]
    mesh.from_pydata(vertices, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    mesh.uv_layers.new(name="UVMap")
    mesh.materials.append(_material(name))
    body = bpy.data.objects.new(mesh.name, mesh)
    bpy.context.scene.collection.objects.link(body)
    for bone_name, indices in groups.items():
        body.vertex_groups.new(name=bone_name).add(list(indices), 1.0, "REPLACE")
    body.parent = armature
    body.modifiers.new("Armature", "ARMATURE").object = armature
    stick = bpy.data.objects.new(f"{name} stick", bpy.data.meshes.new("stick"))
    stick.data.from_pydata(*[list(part)
                             for part in (_box((-0.01, -0.01, 0), (0.01, 0.01, 1.0), turn)[0], [],
                                          _box((-0.01, -0.01, 0), (0.01, 0.01, 1.0), turn)[1])])
    bpy.context.scene.collection.objects.link(stick)
    stick.parent, stick.parent_type, stick.parent_bone = armature, "BONE", "hand.R"
    return armature


def _material(name):
    image = bpy.data.images.new(f"{name} texture", 8, 8)
    image.pixels = [0.2, 0.5, 0.8, 1.0] * 64
    image.pack()
    material = bpy.data.materials.new(f"{name} cloth")
    material.use_nodes = True
    texture = material.node_tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    material.node_tree.links.new(texture.outputs[0], shader.inputs["Base Color"])
    return material


def _foot(phase, stride, stance):
    """(x, z) of an ankle at a phase of its own cycle: planted from 0, flat; under the hip in mid-stance."""
    reach = 0.5 * stance * stride
    if phase < stance:
        return reach - phase * stride, ANKLE
    t = (phase - stance) / (1.0 - stance)
    s = t * t * (3.0 - 2.0 * t)
    return -reach + 2.0 * reach * s, ANKLE + 0.12 * math.sin(math.pi * t)


def _leg(ankle, hip_height):
    """World angles (thigh, shin) about the sideways axis, positive = forwards."""
    dx, dz = ankle[0], hip_height - ankle[1]
    d = min(math.hypot(dx, dz), (THIGH + SHIN) * 0.9999)
    knee = math.acos((THIGH ** 2 + d ** 2 - SHIN ** 2) / (2 * THIGH * d))
    thigh = math.atan2(dx, dz) + knee
    shin = math.atan2(dx - THIGH * math.sin(thigh), dz - THIGH * math.cos(thigh))
    return thigh, shin


def add_clip(armature, name, stride=0.0, stance=0.6, frames=24, cycles=1, offset=0.25, travels=False, backwards=False,
             heading=180.0, closed=True):
    """An action on an NLA track of its own. The right foot comes down at `offset` of the cycle; stride 0 nods."""
    scale = armature.data.bones["thigh.R"].length / THIGH
    data = armature.animation_data_create()
    action = bpy.data.actions.new(name)
    data.action = action
    if hasattr(data, "action_slot") and data.action_slot is None:
        data.action_slot = action.slots.new("OBJECT", armature.name)
    turn = Matrix.Rotation(math.radians(heading), 3, "Z")
    sideways = turn @ Vector((0.0, 1.0, 0.0))
    drop = 0.0 if stride == 0.0 else 0.05 + 0.03 * stride

    def rotate(bone, angle, frame):
        rest = armature.data.bones[bone].matrix_local.to_3x3()
        pose = armature.pose.bones[bone]
        pose.rotation_mode = "QUATERNION"
        pose.rotation_quaternion = (rest.inverted() @ Matrix.Rotation(-angle, 3, sideways) @ rest).to_quaternion()
        pose.keyframe_insert("rotation_quaternion", frame=frame)

    for frame in range(frames * cycles + (1 if closed else 0)):
        share = frame / frames
        phase = -share if backwards else share
        for side, later in (("R", 0.0), ("L", 0.5)):
            own = (phase - offset - later) % 1.0
            hip = ANKLE + THIGH + SHIN - drop
            thigh, shin = _leg(_foot(own, stride, stance), hip) if stride else (0.0, 0.0)
            rotate(f"thigh.{side}", thigh, frame)
            rotate(f"shin.{side}", shin - thigh, frame)
            rotate(f"end.{side}", -shin, frame)
            rotate(f"arm.{side}", -0.8 * thigh, frame)
        rotate("torso", 0.03 * math.sin(2.0 * math.pi * share), frame)
        pelvis = armature.pose.bones["pelvis"]
        rest = armature.data.bones["pelvis"].matrix_local.to_3x3()
        way = turn @ Vector((stride * share if travels else 0.0, 0.0, 0.0)) + Vector((0.0, 0.0, -drop))
        pelvis.location = rest.inverted() @ (way * scale)
        pelvis.keyframe_insert("location", frame=frame)
    track = data.nla_tracks.new()
    track.name = name
    slot = getattr(data, "action_slot", None)
    strip = track.strips.new(name, 0, action)
    if slot is not None:
        strip.action_slot = slot
    track.mute = True
    data.action = None
    for bone in armature.pose.bones:
        bone.matrix_basis = Matrix.Identity(4)
    return action
