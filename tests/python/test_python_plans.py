# SPDX-License-Identifier: Apache-2.0
"""Plans and maps become layouts: walls where they are drawn, people who come through, and a report of the rest."""
import json

import pytest
import shapely

import throng_io
from throng_io import cli
from throng_io.base.geometry import wall_shape
from throng_io.importers.formats import read_scene
from throng_io.importers.options import Options
from throng_io.importers.tags import meaning, metres
from throng_io.importers.wall_faces import Face, walls_of

ezdxf = pytest.importorskip("ezdxf", reason="ezdxf is not installed")
pytest.importorskip("pyproj", reason="pyproj is not installed")
pytest.importorskip("svgelements", reason="svgelements is not installed")

SVG = """<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 1400 900"><title>plan</title>
<g inkscape:label="Walls" style="fill:none;stroke:black;stroke-width:20">
<path d="M 10 10 H 1390 V 890 H 10 Z"/><path d="M 700 10 v 300"/><path d="M 700 600 V 890"/>
<g transform="translate(300,300)"><rect id="pillar" width="60" height="40" style="fill:black"/></g>
<use xlink:href="#pillar" x="700" y="300"/>
<path d="M 900 200 C 900 300 1000 300 1000 200"/></g>
<g id="entry"><rect x="30" y="400" width="100" height="100"/></g>
<g id="furniture"><rect x="100" y="100" width="50" height="50"/></g>
<text x="5" y="5">Hall</text></svg>"""

OSM = """<osm version="0.6"><bounds minlat="0" minlon="0" maxlat="1" maxlon="1"/>
<node id="1" lat="52.0000" lon="13.0000"/><node id="2" lat="52.0000" lon="13.0005"/>
<node id="3" lat="52.0003" lon="13.0005"/><node id="4" lat="52.0001" lon="13.0001"/>
<node id="5" lat="52.0001" lon="13.0003"/><node id="6" lat="52.0002" lon="13.0003"/>
<node id="7" lat="52.0002" lon="13.0001"/><node id="8" lat="52.00013" lon="13.00015"/>
<node id="9" lat="52.00013" lon="13.00025"/><node id="10" lat="52.00017" lon="13.00025"/>
<node id="11" lat="52.00017" lon="13.00015"/><node id="12" lat="52.00025" lon="13.0001"><tag k="barrier" v="bollard"/>
</node>
<way id="1"><nd ref="1"/><nd ref="2"/><tag k="highway" v="footway"/><tag k="width" v="4 m"/><tag k="name" v="Lane"/>
</way>
<way id="2"><nd ref="2"/><nd ref="3"/><tag k="highway" v="steps"/></way>
<way id="3"><nd ref="4"/><nd ref="5"/><nd ref="6"/><nd ref="7"/><nd ref="4"/></way>
<way id="4"><nd ref="8"/><nd ref="9"/><nd ref="10"/><nd ref="11"/><nd ref="8"/></way>
<way id="5"><nd ref="7"/><nd ref="12"/><tag k="barrier" v="hedge"/></way>
<way id="6"><nd ref="1"/><nd ref="6"/><tag k="highway" v="motorway"/></way>
<way id="7"><nd ref="1"/><nd ref="6"/><nd ref="99"/><tag k="highway" v="footway"/><tag k="layer" v="1"/></way>
<relation id="1"><member type="way" ref="3" role="outer"/><member type="way" ref="4" role="inner"/>
<tag k="type" v="multipolygon"/><tag k="building" v="yes"/><tag k="building:levels" v="4"/></relation>
<relation id="2"><tag k="type" v="route"/></relation></osm>"""


def geojson(*features, **more):
    return json.dumps({"type": "FeatureCollection", **more, "features": [
        {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": coordinates}}
        for kind, coordinates, properties in features]})


GEOJSON = geojson(
    ("Polygon", [[[0, 0], [3, 0], [3, 4], [0, 4], [0, 0]], [[1, 1], [2, 1], [2, 2], [1, 2], [1, 1]]],
     {"building": "yes", "height": 7}),
    ("LineString", [[-8, -3], [12, -3]], {"throng": "road", "width": 5, "name": "street"}),
    ("MultiLineString", [[[-8, 6], [12, 6]], [[-8, 9], [12, 9]]], {"throng": "wall", "thickness": 0.4}),
    ("Polygon", [[[10, -6], [13, -6], [13, -1], [10, -1], [10, -6]]], {"throng": "area", "name": "end"}),
    ("Polygon", [[[20, 0], [24, 4], [24, 0], [20, 4], [20, 0]]], {"throng": "wall"}),
    ("Point", [1, 1], {"natural": "tree"}), ("Polygon", [[[5, 5], [6, 5], [6, 6], [5, 5]]], {"throng": "tree"}))


def write_dxf(path, units=4, change=lambda document: None):
    """A hall of 12 x 8 m in millimetres, its walls 20 cm between two faces, with an arc, a pillar and a door."""
    document = ezdxf.new(units=units)
    for layer in ("A-WALL", "A-FURNITURE", "A-AREA"):
        document.layers.add(layer)
    space = document.modelspace()
    for width in (0, 200):
        space.add_lwpolyline([(-width, -width), (12000 + width, -width), (12000 + width, 8000 + width),
                              (-width, 8000 + width)], close=True, dxfattribs={"layer": "A-WALL"})
    for x in (6000, 6150):
        space.add_line((x, 0), (x, 3000), dxfattribs={"layer": "A-WALL"})
    space.add_arc((9000, 4000), 1000, 0, 180, dxfattribs={"layer": "A-WALL"})
    column = document.blocks.new("column")
    column.add_circle((0, 0), 300, dxfattribs={"layer": "A-WALL"})
    space.add_blockref("column", (3000, 5000))
    space.add_lwpolyline([(500, 500), (1500, 500), (1500, 1500), (500, 1500)], close=True,
                         dxfattribs={"layer": "A-AREA"})
    space.add_line((100, 100), (200, 200), dxfattribs={"layer": "A-FURNITURE"})
    space.add_text("Hall")
    change(document)
    document.saveas(path)
    return path


def write_plan(name, folder):
    if name == "dxf":
        return write_dxf(folder / "plan.dxf")
    file, text = {"svg": ("plan.svg", SVG), "osm": ("map.osm", OSM), "geojson": ("plan.geojson", GEOJSON)}[name]
    (folder / file).write_text(text)
    return folder / file


@pytest.mark.parametrize("name", ["dxf", "svg", "osm", "geojson"])
def test_plans_bake_and_everybody_arrives(name, throng, tmp_path):
    extra = ["--unit", "1"] if name == "geojson" else []
    assert cli.main(["import", str(write_plan(name, tmp_path)), "-o", str(tmp_path / "layout.json"), "--people", "8",
                     "--report", "json", *extra]) == 0
    assert throng_io.check(tmp_path / "layout.json", throng.binary) == []
    bake = throng_io.bake(tmp_path / "layout.json", tmp_path / "bake", program=throng.binary)
    assert bake.agents == 8 and bake.account["arrived"] == 8


def covered(layout):
    return shapely.union_all([wall_shape(wall) for wall in layout["walls"]])


def test_dxf_walls_are_between_their_faces(tmp_path):
    found = read_scene(write_dxf(tmp_path / "plan.dxf"))
    walls = covered(found.layout)
    ring = shapely.box(-0.2, -0.2, 12.2, 8.2).difference(shapely.box(0, 0, 12, 8))
    assert ring.difference(walls).area < 0.2  # but for corners, which thin walls close
    assert walls.covers(shapely.box(6.001, 0.1, 6.149, 2.999))
    assert walls.intersection(shapely.box(0.2, 0.2, 5.8, 7.8)).area == pytest.approx(3.14159 * 0.09, rel=0.03)
    arc = shapely.Point(9, 4).buffer(1.0, quad_segs=64).exterior.intersection(shapely.box(7, 4, 11, 6))
    thin = [wall for wall in found.layout["walls"] if not wall.get("closed")]
    assert arc.hausdorff_distance(shapely.union_all([shapely.LineString(wall["points"]) for wall in thin
                                                     if 7 < wall["points"][0][0] < 11 and
                                                     4 <= wall["points"][0][1] < 6])) < 0.03
    assert found.layout["areas"][0]["polygon"][0] == [0.5, 0.5]
    assert ("TEXT entities", "are no lines") in found.report.left
    assert ("LINE entities of the layer A-FURNITURE", "not a layer that is chosen") in found.report.left


def test_dxf_layers_and_units_can_be_chosen(tmp_path):
    source = write_dxf(tmp_path / "plan.dxf", units=0)
    found = read_scene(source, Options(walls=("*furn*",), skip=(), unit=0.1))
    wall, = found.layout["walls"]
    assert wall["points"] == [[10, 10], [20, 20]]


def test_two_faces_are_one_wall():
    def walls(*pairs):
        return walls_of([Face(*pair) for pair in pairs])

    solid, lines = walls(((0, 0), (4, 0)), ((5, 0.3), (1, 0.3)))
    assert [piece.equals(shapely.box(1, 0, 4, 0.3)) for piece in solid] == [True]
    assert sorted(lines) == [[(0.0, 0.0), (1.0, 0.0)], [(5.0, 0.3), (4.0, 0.3)]]
    assert walls(((0, 0), (4, 0)), ((0, 0.7), (4, 0.7)))[0] == []      # too far from each other
    assert walls(((0, 0), (4, 0)), ((0, 0.2), (4, 0.6)))[0] == []      # not parallel
    three, rest = walls(((0, 0), (4, 0)), ((0, 0.2), (4, 0.2)), ((0, 0.5), (4, 0.5)))
    assert len(three) == 1 and three[0].area == pytest.approx(0.8) and len(rest) == 1


def test_svg_strokes_are_as_thick_as_they_are_drawn(tmp_path):
    found = read_scene(write_plan("svg", tmp_path))
    lines = [wall for wall in found.layout["walls"] if not wall.get("closed")]
    solids = [shapely.Polygon(wall["points"]) for wall in found.layout["walls"] if wall.get("closed")]
    assert all(wall["thickness"] == pytest.approx(0.2) for wall in lines)
    assert lines[1]["points"] == [[7, -0.1], [7, -3.1]]
    assert [piece.bounds for piece in solids] == [(3, -3.4, 3.6, -3), (7, -3.4, 7.6, -3)]
    curve = shapely.LineString(lines[3]["points"])
    assert curve.interpolate(0.5, normalized=True).distance(shapely.Point(9.5, -2.75)) < 0.01
    assert found.layout["areas"][0]["polygon"][0] == [0.3, -4.0]
    assert ("<text>", "is no shape") in found.report.left
    assert ("shapes of furniture", "not a layer that is chosen") in found.report.left


def test_osm_is_metres_about_its_middle(tmp_path):
    found = read_scene(write_plan("osm", tmp_path))
    lane, steps = found.layout["roads"]
    (x, y), (far, _) = lane["centreline"]
    assert lane["id"] == "Lane" and lane["width"] == 4 and steps["id"] == "step 2"
    assert far - x == pytest.approx(34.33, abs=0.02) and y == pytest.approx(-16.7, abs=0.1)
    building = [wall for wall in found.layout["walls"] if wall.get("closed")]
    assert sum(shapely.Polygon(wall["points"]).area for wall in building) == pytest.approx(
        13.73 * 11.13 - 6.866 * 4.45, rel=0.01) and {wall["height"] for wall in building} == {12}
    for what in (("highway=motorway", "not for people on foot"), ("highway=footway", "on another storey"),
                 ("relations of the type route", "has no counterpart"),
                 ("nodes with barrier=bollard", "have no extent")):
        assert found.report.left[what] == 1
    assert found.report.changed["steps", "are flat here"] == 1


def test_tags_have_sizes():
    assert [metres(text, 2) for text in ("4", "4.5 m", "10 ft", "wide", None, "1;2")] == [4, 4.5, 3.048, 2, 2, 1]
    assert meaning({"highway": "pedestrian", "area": "yes"}, True).kind == "area"
    assert meaning({"highway": "footway", "footway": "crossing"}, False).what == "crossings"
    assert meaning({"barrier": "wall", "height": "1.2"}, False).height == 1.2
    assert meaning({"building": "yes", "layer": "-1"}, True).kind == ""
    assert meaning({"source": "survey"}, True) is None


def test_geojson_has_tags_or_kinds(tmp_path):
    found = read_scene(write_plan("geojson", tmp_path), Options(unit=1.0))
    walls = found.layout["walls"]
    building = [wall for wall in walls if wall.get("height") == 7]
    assert sum(shapely.Polygon(wall["points"]).area for wall in building) == pytest.approx(11)
    assert [wall["thickness"] for wall in walls if not wall.get("closed")] == [0.4, 0.4]
    assert found.layout["roads"][0] == {"id": "street", "centreline": [[-8, -3], [12, -3]], "width": 5}
    assert found.layout["areas"][0]["id"] == "end"
    assert found.report.changed["walls", "crossed themselves, and were mended"] == 1
    assert found.report.left["features with throng=tree", "expected wall, area or road"] == 1


def test_geojson_of_a_named_system(tmp_path):
    text = geojson(("LineString", [[500000, 5761000], [500100, 5761000]], {"throng": "wall"}),
                   crs={"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}})
    (tmp_path / "a.geojson").write_text(text)
    (x, _), (far, _) = read_scene(tmp_path / "a.geojson").layout["walls"][0]["points"]
    assert far - x == pytest.approx(100 / 0.9996, abs=0.01)


def cyclic(document):
    for name, other in (("one", "two"), ("two", "one")):
        document.blocks.new(name).add_blockref(other, (0, 0))
    document.modelspace().add_blockref("one", (0, 0))


def many(document):
    for level in range(12):
        block = document.blocks.new(f"level{level}")
        for _ in range(10):
            if level:
                block.add_blockref(f"level{level - 1}", (0, 0))
            else:
                block.add_line((0, 0), (1, 1))
    document.modelspace().add_blockref("level11", (0, 0))


HOSTILE_SVG = '<svg xmlns="http://www.w3.org/2000/svg">{}</svg>'
HOSTILE = {
    "self.svg": (HOSTILE_SVG.format('<g id="a"><use href="#a"/></g>'), "in a circle"),
    "laughs.svg": (HOSTILE_SVG.format("".join(
        f'<g id="g{n}">' + (f'<use href="#g{n - 1}"/>' * 40 if n else '<path d="M0 0L9 9"/>') + "</g>"
        for n in range(9))), "more than 200,000 shapes"),
    "bomb.svg": ('<!DOCTYPE svg [<!ENTITY a "b">]><svg xmlns="http://www.w3.org/2000/svg"/>', "entities of its own"),
    "nan.svg": (HOSTILE_SVG.format('<path d="M 0 0 L 5 5" transform="scale(1e400)"/>'), "transform that is none"),
    "far.svg": (HOSTILE_SVG.format('<path d="M 0 0 L 1e300 5"/>'), "expected coordinates"),
    "empty.svg": (HOSTILE_SVG.format(""), "nothing that a layout can hold"),
    "cut.dxf": ("0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n", "DXF"),
    "wide.osm": (OSM.replace('lon="13.0000"', 'lon="19"'), "wider than 2 degrees"),
    "nan.osm": (OSM.replace('lon="13.0000"', 'lon="nan"'), "expected a number"),
    "none.osm": ("<osm/>", "has no nodes"),
    "nan.geojson": (GEOJSON.replace("[0, 0]", "[NaN, 0]", 1), "NaN is no number"),
    "form.geojson": (geojson(("Polygon", 3, {})), "a geometry that is none"),
    "crs.geojson": (geojson(("LineString", [[0, 0], [1, 1]], {}), crs={"properties": {"name": "EPSG:0"}}),
                    "which is not known"),
    "empty.geojson": (geojson(), "finite coordinates"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_plans_end_in_one_sentence(name, tmp_path, capsys):
    text, told = HOSTILE[name]
    (tmp_path / name).write_text(text)
    assert cli.main(["import", str(tmp_path / name), "-o", str(tmp_path / "layout.json")]) == 3
    errors = capsys.readouterr().err
    assert told in errors and "Traceback" not in errors and not (tmp_path / "layout.json").exists()


@pytest.mark.parametrize("change, told", [(cyclic, "holds itself"), (many, "hold more than 500,000")])
def test_hostile_blocks_end_in_one_sentence(change, told, tmp_path):
    with pytest.raises(throng_io.ImportFailed, match=told):
        read_scene(write_dxf(tmp_path / "plan.dxf", change=change))


def test_a_plan_without_ground_is_told(tmp_path):
    (tmp_path / "full.geojson").write_text(geojson(("LineString", [[0, 0], [0.1, 0]], {"throng": "road"})))
    with pytest.raises(throng_io.ImportFailed, match="no ground for people"):
        read_scene(tmp_path / "full.geojson", Options(unit=1.0, people=5))


def test_plans_of_areas_alone_have_ground(tmp_path):
    (tmp_path / "areas.geojson").write_text(geojson(
        ("Polygon", [[[0, 0], [9, 0], [9, 5], [0, 5], [0, 0]]], {"throng": "area"})))
    found = read_scene(tmp_path / "areas.geojson", Options(unit=1.0, people=6))
    assert sum(flow["count"] for flow in found.layout["flows"]) == 6
