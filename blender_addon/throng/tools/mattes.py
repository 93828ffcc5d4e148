# SPDX-License-Identifier: Apache-2.0
"""Mattes by person: everybody's numbers (formats/person_codes.py) on the crowd's points, and materials that write them
into passes of the render. It is all in the scene, so a farm needs no add-on; `scripts/person_mattes.py` makes a
Cryptomatte of what has been rendered."""
from ..blender.nodes import of_person
from ..cast import library
from ..crowd.queries import bake_path, cast_of, crowd_objects, why_fixed
from ..formats import load_bake
from ..formats.person_codes import ATTRIBUTES, PASSES, person_codes, person_name
from ..overrides.hero import HERO_ROW, heroes_of
from ..overrides.native import retimed_object

_LABEL = "throng person"  # of the nodes in materials
_DONE = "throng_mattes"   # a crowd whose people are numbered


def apply(scene):
    """Lets renders of a scene tell all people of its crowds apart. Raises BakeError."""
    for layer in scene.view_layers:
        for name in PASSES:
            if name not in layer.aovs:
                aov = layer.aovs.add()
                aov.name, aov.type = name, "COLOR"
    for crowd in crowd_objects(scene):
        if not why_fixed(crowd):
            number(crowd)


def follow(crowd):
    """After its bake has changed: numbers whoever is in it now, where the crowd has mattes."""
    if crowd.get(_DONE):
        number(crowd)


def number(crowd):
    """Gives everybody in a crowd their numbers, and its materials what writes them; harmless to do again."""
    name = load_bake(bake_path(crowd)).name
    _number_points(crowd.data, [person_name(name, row) for row in range(len(crowd.data.vertices))])
    retimed = retimed_object(crowd)
    if retimed:  # who is retimed has the id of a row of the crowd
        _number_points(retimed.data, [person_name(name, each.value) for each in retimed.data.attributes["id"].data])
    materials = {material for figure in library.figures_of(cast_of(crowd)).values() for material in _materials(figure)}
    for hero in heroes_of(crowd).values():
        for body in (each for each in hero.children if each.type == "MESH"):
            for attribute, values in zip(ATTRIBUTES, person_codes(person_name(name, hero[HERO_ROW]))):
                body[attribute] = values
            materials.update(_materials(body))
    for material in sorted(materials, key=lambda each: each.name):
        _write_passes(material)
    crowd[_DONE] = True
    crowd.update_tag()


def _materials(thing):
    return [slot.material for slot in thing.material_slots if slot.material]


def _number_points(mesh, names):
    codes = [person_codes(name) for name in names]
    for part, attribute in enumerate(ATTRIBUTES):
        if attribute in mesh.attributes:
            mesh.attributes.remove(mesh.attributes[attribute])
        mesh.attributes.new(attribute, "FLOAT_VECTOR", "POINT")
        mesh.attributes[attribute].data.foreach_set("vector", [value for code in codes for value in code[part]])


def _write_passes(material):
    """Nodes that write the numbers of whoever wears a material. Nothing else of it changes."""
    if material.library or not material.use_nodes:
        return
    nodes = material.node_tree.nodes
    if any(node.label == _LABEL for node in nodes):
        return
    for attribute, name in zip(ATTRIBUTES, PASSES):
        target = nodes.new("ShaderNodeOutputAOV")
        # which reads the object's own property where there is no instancer: a hero's
        sources, codes = of_person(material.node_tree, attribute)
        setattr(target, "aov_name" if hasattr(target, "aov_name") else "name", name)
        for node in (*sources, target):
            node.label = _LABEL
        material.node_tree.links.new(codes, target.inputs["Color"])
