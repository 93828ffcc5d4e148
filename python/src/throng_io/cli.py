# SPDX-License-Identifier: Apache-2.0
"""throng-io: scenes of other programs in, crowds to other programs out."""
from __future__ import annotations

import argparse
import dataclasses
import json
import math
import pathlib
import sys

from . import __version__
from .bakes.bake import Bake
from .base.errors import ThrongError
from .base.whole_files import whole_file
from .gltf.crowd import Form, export_gltf
from .gltf.kit import export_kit
from .gltf.textures import KINDS
from .gltf.vat import export_vat
from .importers.formats import read_scene
from .importers.options import Options
from .skinned.members import LEVELS, MOST_MEMBERS
from .skinned.shot import Wanted
from .usd.crowd import export_usd
from .usd.skeletons import Skeletons

USAGE, INVALID = 2, 3
EXPORTS = {".csv": Bake.to_csv, ".sqlite": Bake.to_jupedsim_sqlite}


def export(given: argparse.Namespace) -> None:
    write = EXPORTS.get(pathlib.Path(given.output).suffix.lower())
    if not write:
        raise ThrongError(f"{given.output}: expected a name that ends in {' or '.join(EXPORTS)}")
    write(Bake(given.bake), given.output, given.every)


def to_usd(given: argparse.Namespace) -> None:
    if given.skeletons and given.chunk:
        raise ThrongError("--chunk is about simple figures", "leave --skeletons out")
    if not given.skeletons and (given.most or given.near or given.copies):
        raise ThrongError("--most, --near and --copies are about skeletons", "add --skeletons")
    wanted = Skeletons(given.most, tuple(given.near) if given.near else None,
                       not given.copies) if given.skeletons else None
    export_usd(Bake(given.bake), given.output, given.every, wanted, given.bare, given.chunk)


def wanted_of(given: argparse.Namespace) -> Wanted:
    return Wanted(given.most, tuple(given.near) if given.near else None, given.every,
                  tuple(given.seconds) if given.seconds else None, given.members)


def form_of(given: argparse.Namespace, levels: tuple[str, ...] = LEVELS[:1]) -> Form:
    return Form(tuple(given.level or levels), given.quantize, given.compress)


def to_gltf(given: argparse.Namespace) -> None:
    written = export_gltf(Bake(given.bake), given.output, wanted_of(given), form_of(given), given.others,
                          not given.no_ground)
    if written.left_out and given.most is None:
        print(f"throng-io: {written.people} people have skeletons, {written.left_out} are left out: --most N takes "
              "more, --every N and --seconds A B fewer frames", file=sys.stderr)


def to_kit(given: argparse.Namespace) -> None:
    export_kit(Bake(given.bake), given.output, wanted_of(given), form_of(given, LEVELS), not given.no_ground)


def to_vat(given: argparse.Namespace) -> None:
    export_vat(Bake(given.bake), given.output, wanted_of(given), given.level, given.texture, not given.no_ground)


def import_scene(given: argparse.Namespace) -> None:
    chosen = {field.name: value for field in dataclasses.fields(Options)
              if (value := getattr(given, field.name)) is not None}
    imported = read_scene(given.file, Options(**{key: tuple(value) if isinstance(value, list) else value
                                                 for key, value in chosen.items()}))
    with whole_file(given.output) as beside:
        beside.write_text(json.dumps(imported.layout, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    if given.report == "json":
        print(json.dumps(imported.report.as_dict(), indent=1))
    else:
        print(imported.report)


def positive(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"expected 1 or more, found {text}")
    return number


def above_zero(text: str) -> float:
    number = float(text)
    if not 1e-6 <= number <= 1e6:
        raise argparse.ArgumentTypeError(f"expected a number above 0, found {text}")
    return number


def finite(text: str) -> float:
    number = float(text)
    if not math.isfinite(number):
        raise argparse.ArgumentTypeError(f"expected a number, found {text}")
    return number


def parser() -> argparse.ArgumentParser:
    top = argparse.ArgumentParser(prog="throng-io", description=__doc__.partition(": ")[2].strip())
    top.add_argument("--version", action="version", version=f"throng-io {__version__}")
    commands = top.add_subparsers(required=True, metavar="COMMAND")
    of_bake(commands, "export", "write a bake's trajectories: .csv, or .sqlite as JuPedSim does", export)
    usd_options(of_bake(commands, "export-usd", "write a bake as USD: people in poses, walls and ground", to_usd,
                        "the file to write: .usdc, .usda or .usd"))
    command = of_bake(commands, "export-gltf", "write a bake as glTF for engines: people with skeletons, one animation",
                      to_gltf, "the file to write: .glb")
    people_options(command)
    form_options(command)
    command.add_argument("--others", action="store_true",
                         help="who has no skeleton is an instance that stands still (EXT_mesh_gpu_instancing)")
    command = of_bake(commands, "export-kit", "write members of the cast with clips as glTF, and a table of who plays "
                      "which of them where", to_kit, "the folder to write")
    people_options(command)
    form_options(command)
    command = of_bake(commands, "export-vat", "write members of the cast as meshes with vertex animation textures, "
                      "and the same table", to_vat, "the folder to write")
    people_options(command)
    command.add_argument("--level", choices=LEVELS, default=LEVELS[-1], help="how fine meshes are (far)")
    command.add_argument("--texture", choices=KINDS, default="float",
                         help="OpenEXR of 32 bits (float) or 16 (half), or PNG of 16")
    import_options(commands.add_parser("import", help="make a layout of another program's scene"))
    return top


def of_bake(commands, name: str, told: str, run, output: str = "the file to write") -> argparse.ArgumentParser:
    """A command that writes something else of a bake."""
    command = commands.add_parser(name, help=told)
    command.add_argument("bake", help="a bake's folder")
    command.add_argument("-o", "--output", required=True, help=output)
    command.add_argument("--every", type=positive, default=1, metavar="N", help="only every N-th frame")
    command.set_defaults(run=run)
    return command


def people_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--most", type=positive, metavar="N", help="N people at most; others are left out")
    command.add_argument("--near", type=finite, nargs=2, metavar=("X", "Y"),
                         help="of these those who come nearest to a place of the world")
    command.add_argument("--seconds", type=finite, nargs=2, metavar=("A", "B"), help="only from one moment to another")
    command.add_argument("--members", type=positive, default=MOST_MEMBERS, metavar="N",
                         help=f"of N different people at most (1 to {MOST_MEMBERS})")
    command.add_argument("--no-ground", action="store_true", help="without ground, roads, walls, vehicles and lifts")


def form_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--level", choices=LEVELS, action="append",
                         help="how fine meshes are; several times: levels of detail (MSFT_lod)")
    command.add_argument("--quantize", action="store_true", help="shorter numbers (KHR_mesh_quantization)")
    command.add_argument("--compress", action="store_true", help="packed by meshoptimizer (EXT_meshopt_compression)")


def usd_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--bare", action="store_true", help="without ground, walls, camera and lights")
    command.add_argument("--chunk", type=positive, metavar="N",
                         help="long shots: what people do in a file of its own for every N frames, beside the stage")
    command.add_argument("--skeletons", action="store_true",
                         help="people with skeletons and motions (UsdSkel), shaped from the library of bodies")
    command.add_argument("--most", type=positive, metavar="N",
                         help="skeletons: of N people at most; others are left out")
    command.add_argument("--near", type=finite, nargs=2, metavar=("X", "Y"),
                         help="skeletons: of these those who come nearest to a place of the world")
    command.add_argument("--copies", action="store_true",
                         help="skeletons: people are no instances, which Blender would leave at rest")


def import_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", help="the scene: its name or its content says of which program")
    command.add_argument("-o", "--output", required=True, help="the layout to write")
    command.add_argument("--report", choices=("text", "json"), nargs="?", const="text", default="text",
                         help="how to tell what was taken over, changed and left out")
    for kind in ("walls", "areas", "roads", "skip"):
        command.add_argument(f"--{kind}", action="append", metavar="PATTERN",
                             help=f"DXF, SVG: layers that are {'left out' if kind == 'skip' else kind} (repeatable)")
    command.add_argument("--unit", type=above_zero, metavar="METRES", help="DXF, SVG, GeoJSON: a unit of the file")
    command.add_argument("--tolerance", type=above_zero, metavar="METRES", help="DXF, SVG: how far off curves may be")
    command.add_argument("--crs", metavar="NAME", help="GeoJSON: its system of coordinates, e.g. EPSG:25832")
    command.add_argument("--people", type=positive, metavar="N", help="so many people, where nobody is in a plan")
    command.set_defaults(run=import_scene)


def main(arguments: list[str] | None = None) -> int:
    given = parser().parse_args(arguments)
    try:
        return given.run(given) or 0
    except ThrongError as error:
        print(f"throng-io: {error}", file=sys.stderr)
        return INVALID
    except OSError as error:
        print(f"throng-io: {error.filename}: {error.strerror}", file=sys.stderr)
        return INVALID


if __name__ == "__main__":
    sys.exit(main())
