# SPDX-License-Identifier: Apache-2.0
"""Who of the cast somebody appears as where that follows from the person and is not drawn: an attribute of the crowd's
points, one more than the member's number. 0 leaves it to the bake's draw, as does an override that swaps somebody."""
from ..people import casting, members

OWN = "throng_own"
FIRST = "throng_own_first"  # as it was before overrides


def give(crowd, cast, folder):
    """To all people of a bake; harmless where the cast is not shaped from bodies."""
    mesh = crowd.data
    for name in (OWN, FIRST):
        if name in mesh.attributes:
            mesh.attributes.remove(mesh.attributes[name])
    if not cast.get("throng_bodies"):
        return
    walkers = casting.read_walkers(folder)
    if walkers is None or len(walkers) != len(mesh.vertices):
        return
    chosen = casting.choose(walkers, members.roles_of(cast), max(1, cast["throng_drawn"]))
    numbers = [0.0 if walker.chosen else float(number + 1) for walker, number in zip(walkers, chosen)]
    for name in (OWN, FIRST):
        mesh.attributes.new(name, "FLOAT", "POINT").data.foreach_set("value", numbers)


def let_swap(mesh, rows):
    """Those rows show what an override says; all others are as they were."""
    if FIRST not in mesh.attributes:
        return
    numbers = [0.0] * len(mesh.vertices)
    mesh.attributes[FIRST].data.foreach_get("value", numbers)
    for row in rows:
        numbers[row] = 0.0
    mesh.attributes[OWN].data.foreach_set("value", numbers)


def member_of(crowd, row, variation, swapped):
    """The number of the member that somebody shows; as the instancer has it, for those who joined not."""
    if not swapped and OWN in crowd.data.attributes:
        own = int(crowd.data.attributes[OWN].data[row].value)
        if own:
            return own - 1
    return variation % crowd["throng_cast"]["throng_variations"]
