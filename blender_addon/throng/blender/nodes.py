# SPDX-License-Identifier: Apache-2.0
"""Small helpers over node trees, whose interface changed in Blender 4.0."""
import bpy


def new_tree(name, inputs=(), outputs=(), kind="GeometryNodeTree"):
    """A node tree, of geometry unless told, with sockets [(name, type)]; returns (tree, input node, output node)."""
    tree = bpy.data.node_groups.new(name, kind)
    for direction, sockets in (("INPUT", inputs), ("OUTPUT", outputs)):
        for socket_name, socket_kind in sockets:
            if hasattr(tree, "interface"):
                tree.interface.new_socket(name=socket_name, in_out=direction, socket_type=socket_kind)
            else:
                (tree.inputs if direction == "INPUT" else tree.outputs).new(socket_kind, socket_name)
    return tree, tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")


def own_tree(name):
    """The node tree of a name that is in this file, and not one of a library that it links: those may go away."""
    return bpy.data.node_groups.get((name, None))


def drop_tree(tree):
    """Removes a node tree that nobody uses any more, with the groups in it, and in these, that nobody else does."""
    if tree is None or tree.users:
        return
    inner = {node.node_tree for node in tree.nodes if node.type == "GROUP" and node.node_tree}
    bpy.data.node_groups.remove(tree)
    for group in inner:
        drop_tree(group)


def _identifier(modifier, name):
    tree = modifier.node_group
    sockets = tree.interface.items_tree if hasattr(tree, "interface") else tree.inputs
    return next(s for s in sockets if s.name == name and getattr(s, "in_out", "INPUT") == "INPUT").identifier


def _slot(modifier, name):
    """From 5.2 on a modifier's inputs are properties of their own; custom properties before."""
    return getattr(modifier.properties.inputs, _identifier(modifier, name)) if hasattr(modifier, "properties") else None


def set_input(modifier, name, value):
    """Sets an input of a node modifier by its socket's name."""
    slot = _slot(modifier, name)
    if slot is None:
        modifier[_identifier(modifier, name)] = value
    else:
        slot.value = value


def get_input(modifier, name):
    slot = _slot(modifier, name)
    return modifier[_identifier(modifier, name)] if slot is None else slot.value


def objects_read(tree):
    """The objects whose geometry a tree of nodes reads."""
    return {node.inputs["Object"].default_value for node in tree.nodes if node.bl_idname == "GeometryNodeObjectInfo"}


def drop_object(thing):
    """Removes an object with its mesh and the trees of its modifiers, where nobody else uses these."""
    mesh, trees = thing.data, [modifier.node_group for modifier in thing.modifiers]
    bpy.data.objects.remove(thing)
    if not mesh.users:
        bpy.data.meshes.remove(mesh)
    for tree in trees:
        drop_tree(tree)


def of_person(tree, name, output="Vector"):
    """What a crowd's points say of a person, in a material: of an instance, or on the vertices of those who are bent
    (crowd/near.py); where it is not there it is 0. Returns (nodes, socket)."""
    found = []
    for kind in ("INSTANCER", "GEOMETRY"):
        node = tree.nodes.new("ShaderNodeAttribute")
        node.attribute_type, node.attribute_name = kind, name
        found.append(node)
    total = tree.nodes.new("ShaderNodeMath" if output == "Fac" else "ShaderNodeVectorMath")
    total.operation = "ADD"
    for node, slot in zip(found, total.inputs):
        tree.links.new(node.outputs[output], slot)
    return [*found, total], total.outputs[0]


def socket(sockets, name=None):
    """The enabled socket of a name: nodes keep hidden twins for other data types."""
    return next(s for s in sockets if s.enabled and (name is None or s.name == name))


class Maths:
    """Writes arithmetic as nodes."""

    def __init__(self, tree):
        self.tree = tree

    def node(self, kind, **settings):
        node = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        return node

    def link(self, source, target):
        self.tree.links.new(source, target)

    def feed(self, value, target):
        """A constant, a number or a tuple of some, or what a socket gives."""
        if isinstance(value, (int, float, tuple)):
            target.default_value = value
        else:
            self.link(value, target)

    def attribute(self, name, kind="FLOAT"):
        """A named attribute's value."""
        node = self.node("GeometryNodeInputNamedAttribute", data_type=kind)
        node.inputs["Name"].default_value = name
        return socket(node.outputs, "Attribute")

    def components(self, name):
        """The three numbers of a vector attribute."""
        separate = self.node("ShaderNodeSeparateXYZ")
        self.link(self.attribute(name, "FLOAT_VECTOR"), separate.inputs[0])
        return separate.outputs

    def store(self, geometry, name, value, kind="FLOAT", only=None):
        """Files a value away as an attribute of points; returns the geometry that has it.

        @param only a boolean attribute: where it is false nothing changes, if the version can do so (3.5); it saves
        work, results must not need it
        """
        node = self.node("GeometryNodeStoreNamedAttribute", data_type=kind, domain="POINT")
        node.inputs["Name"].default_value = name
        self.link(geometry, node.inputs["Geometry"])
        self.link(value, socket(node.inputs, "Value"))
        if only and "Selection" in node.inputs:
            self.link(self.attribute(only, "BOOLEAN"), node.inputs["Selection"])
        return node.outputs[0]

    def math(self, operation, *values):
        node = self.node("ShaderNodeMath", operation=operation)
        for slot, value in zip(node.inputs, values):
            self.feed(value, slot)
        return node.outputs[0]

    def smooth(self, value, low, high):
        """From 0 to 1 as a value goes from `low` to `high`, without corners."""
        node = self.node("ShaderNodeMapRange", interpolation_type="SMOOTHSTEP")
        self.link(value, node.inputs["Value"])
        node.inputs["From Min"].default_value, node.inputs["From Max"].default_value = low, high
        return node.outputs[0]

    def grouped(self, name, geometries, build, kind="NodeSocketGeometry", flag=None):
        """What `build(maths, *geometries)` makes, in a tree of its own: to write a tree takes time that grows with the
        square of its nodes. @param kind of the socket that it gives; @param flag a boolean that goes along, last"""
        sockets = [(f"Geometry {number}", "NodeSocketGeometry") for number in range(len(geometries))]
        given = [*geometries, *([flag] if flag else [])]
        if flag:
            sockets.append(("Flag", "NodeSocketBool"))
        tree, inputs, outputs = new_tree(name, sockets, [("Result", kind)])
        inner = Maths(tree)
        inner.link(build(inner, *inputs.outputs[:len(given)]), outputs.inputs[0])
        node = self.node("GeometryNodeGroup", node_tree=tree)
        for value, slot in zip(given, node.inputs):
            self.link(value, slot)
        return node.outputs[0]

    def geometry_of(self, thing):
        """An object's geometry, as it is in its own space."""
        info = self.node("GeometryNodeObjectInfo", transform_space="ORIGINAL")
        info.inputs["Object"].default_value = thing
        return socket(info.outputs, "Geometry")

    def joined(self, things):
        """The geometry of several objects, one behind the other."""
        everything = self.node("GeometryNodeJoinGeometry")
        for thing in reversed(things):  # what is linked to a Join Geometry last comes out first
            self.link(self.geometry_of(thing), everything.inputs[0])
        return everything.outputs[0]

    def where(self, flag, one, other):
        """One geometry where a flag is set, or the other or None; what is not shown is not worked out."""
        switch = self.node("GeometryNodeSwitch", input_type="GEOMETRY")
        for value, name in ((flag, "Switch"), (one, "True"), (other, "False")):
            if value is not None:
                self.link(value, socket(switch.inputs, name))
        return socket(switch.outputs)

    def any_of(self, points, flags):
        """Whether there are points for whom a number is not 0."""
        count = self.node("GeometryNodeAttributeStatistic", data_type="FLOAT", domain="POINT")
        self.link(points, count.inputs["Geometry"])
        self.link(flags, socket(count.inputs, "Attribute"))
        return self.greater(socket(count.outputs, "Sum"), 0.5)

    def greater(self, value, threshold):
        node = self.node("FunctionNodeCompare", data_type="FLOAT", operation="GREATER_THAN")
        enabled = [s for s in node.inputs if s.enabled]
        self.link(value, enabled[0])
        enabled[1].default_value = threshold
        return socket(node.outputs)

    def equal(self, value, number):
        node = self.node("FunctionNodeCompare", data_type="INT", operation="EQUAL")
        enabled = [s for s in node.inputs if s.enabled]
        self.link(value, enabled[0])
        enabled[1].default_value = number
        return socket(node.outputs)

    def between(self, value, first, last):
        """Whether a number is one of those from the first to the last."""
        middle, reach = 0.5 * (first + last), 0.5 * (last - first) + 0.5
        return self.math("COMPARE", value, middle, reach)
