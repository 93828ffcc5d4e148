# SPDX-License-Identifier: Apache-2.0
"""A crowd for engines that drive it themselves: a glTF file for each member of the cast, with clips, and a table of who
plays which of them where."""
from __future__ import annotations

import dataclasses
import json
import os
import pathlib

import numpy

from ..bakes.bake import Bake
from ..base.whole_files import whole_folder
from ..people import palettes
from ..skinned.clips import Clip, poses_of_clip
from ..skinned.members import LEVELS, Member
from ..skinned.motions import joints_of
from ..skinned.shot import Shot, Wanted
from . import placements
from .crowd import Form, write_surroundings
from .document import Document
from .figures import Figure
from .meshes import Colour, Meshes
from .moves import Moves, beside_those_above

ALL_LEVELS = Form(LEVELS)
SURROUNDINGS = "surroundings.glb"


@dataclasses.dataclass(frozen=True)
class Written:
    people: int
    members: int
    frames: int


def export_kit(bake: Bake, folder: str | os.PathLike, wanted: Wanted = Wanted(), form: Form = ALL_LEVELS,
               ground: bool = True) -> Written:
    """The folder must not be there yet. @param ground with what people walk among, in a file of its own"""
    form.check()
    shot = Shot(bake, wanted)
    clips, numbers = shot.clips, shot.members
    with whole_folder(folder) as beside:
        (beside / "members").mkdir()
        for number in numbers:
            write_member(beside / "members" / f"member{number:02d}.glb", number, shot, clips, form)
        if ground:
            write_surroundings(beside / SURROUNDINGS, shot, form)
        write_table(beside, shot, clips, {number: f"members/member{number:02d}.glb" for number in numbers})
    return Written(len(shot.rows), len(numbers), len(shot.frames))


def write_table(folder: pathlib.Path, shot: Shot, clips: list[Clip], files: dict[int, str], **more) -> None:
    """crowd.json and crowd.bin. @param files of members"""
    told = placements.told(shot, shot.rows, clips)
    if (folder / SURROUNDINGS).exists():
        told["surroundings"] = SURROUNDINGS
    told["members"] = [{"member": number, "file": file, "look": shot.roles[number].look,
                        "profile": shot.roles[number].profile} for number, file in files.items()]
    (folder / "crowd.json").write_text(json.dumps(told | more, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    placements.records_of(shot, shot.rows).tofile(folder / "crowd.bin")


def top_of(member: Member, number: int) -> Colour:
    """The colour that a member's own file shows."""
    choice = palettes.tops(member.role.look)
    return choice[number % len(choice)]


def write_member(path: pathlib.Path, number: int, shot: Shot, clips: list[Clip], form: Form) -> None:
    document, member = Document(form.compress), shot.member(number)
    figure = Figure(Meshes(document, form.quantize), number, member, form.numbers)
    nodes, tops = figure.skeleton()
    root = document.root(name=f"{figure.name} skeleton", children=tops)
    figure.shown_by(figure.name, figure.skin(nodes, root), top_of(member, number))
    places = beside_those_above(member.places, member.parents)
    for clip in clips:
        moves = Moves(document, form.quantize)
        joints = joints_of(_closed(poses_of_clip(clip, member.poses, shot.repertoire)), member.places, member.parents)
        moves.joints(nodes, places, moves.times(numpy.arange(clip.keys + 1) / clip.keys * clip.seconds), joints)
        moves.write(clip.name, clip.told())
    document.extras = {"member": number, "look": member.role.look, "profile": member.role.profile}
    document.write(path)


def _closed(poses: numpy.ndarray) -> numpy.ndarray:
    """With the first pose once more at the end."""
    return numpy.concatenate([poses, poses[:1]])
