# SPDX-License-Identifier: Apache-2.0
"""Runs in Blender's windows: follows docs/tutorials/street-in-blender.md and takes its pictures, or those of a
behaviour or of seats. tutorial|behaviours|seats FOLDER PICTURES

What it does is a generator of steps; between two steps the windows are drawn. A step may yield the seconds to wait.
"""

import math
import os
import sys
import traceback

import addon_utils
import bpy
import mathutils

bake_operator = None  # of the add-on, once it is enabled

subject, folder, pictures = sys.argv[-3:]
SECONDS, ENTERED = 40, 20  # how long the shot is, and when the last of a flow come
FRAME = 500  # the streams have met by then


def window():
    return bpy.context.window_manager.windows[0]


def view():
    return next(area for area in window().screen.areas if area.type == "VIEW_3D")


def region(kind="WINDOW"):
    return next(part for part in view().regions if part.type == kind)


def in_view(kind="WINDOW"):
    return bpy.context.temp_override(window=window(), area=view(), region=region(kind))


def run(operator, *words, **values):
    """As from the interface: with undo, so that the panel of the last operation shows it."""
    with in_view():
        assert operator(*words, True, **values) & {"FINISHED", "RUNNING_MODAL"}, operator


def mouse(kind, value, x, y):
    window().event_simulate(type=kind, value=value, x=int(x), y=int(y))


def click(x, y):
    mouse("MOUSEMOVE", "NOTHING", x, y)
    mouse("LEFTMOUSE", "PRESS", x, y)
    mouse("LEFTMOUSE", "RELEASE", x, y)


def picture(name):
    bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=1)  # as things are by now
    path = os.path.join(pictures, f"{name}.png")
    with bpy.context.temp_override(window=window()):
        bpy.ops.screen.screenshot(filepath=path, check_existing=False)
    print("picture", path, flush=True)


def settle(x, y, z, distance, down=55.0, turned=25.0):
    """The view looks at a place from so far away."""
    of_view = view().spaces.active.region_3d
    of_view.view_perspective = "PERSP"
    of_view.view_location, of_view.view_distance = (x, y, z), distance
    of_view.view_rotation = mathutils.Euler((math.radians(90.0 - down), 0.0, math.radians(turned))).to_quaternion()


def select(*names):
    for thing in bpy.context.view_layer.objects:
        thing.select_set(thing.name in names)
    bpy.context.view_layer.objects.active = bpy.data.objects[names[-1]]


def cursor(x, y):
    bpy.context.scene.cursor.location = (x, y, 0.0)


def open_sidebar():
    """Shows the sidebar's tab Throng: the third one while nothing is selected."""
    view().spaces.active.show_region_ui = True
    yield 1
    click(view().x + view().width - 14, view().y + view().height - 176)
    yield 1
    mouse("MOUSEMOVE", "NOTHING", 400, 400)  # no tooltip, no highlight
    yield 1


def beginning():
    global bake_operator
    addon_utils.enable("throng", default_set=True)
    from throng.authoring import bake_operator

    yield 2
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    bpy.context.scene.frame_end = SECONDS * 24
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "street.blend"))
    yield from open_sidebar()
    settle(0.0, 0.0, 0.0, 40.0)
    yield 1
    picture("panel")


def streets():
    settle(0.0, 0.0, 0.0, 100.0)
    run(bpy.ops.throng.add_road, "EXEC_DEFAULT", length=60.0, width=8.0)
    yield 1
    click(view().x + 100, view().y + 15)  # unfolds the panel of the last operation
    yield 1
    mouse("MOUSEMOVE", "NOTHING", 500, 300)
    yield 1
    picture("road")
    run(bpy.ops.throng.add_road, "EXEC_DEFAULT", length=60.0, width=8.0, angle=math.radians(90.0))
    yield 1


def buildings():
    for x, y in ((17, 17), (-17, 17), (-17, -17), (17, -17)):
        cursor(x, y)
        run(bpy.ops.throng.add_wall, "EXEC_DEFAULT", length=25.0, depth=25.0, closed=True, height=12.0)
        yield 0.5
    cursor(0, 0)


def flows():
    for name in ("Road", "Road.001"):
        select(name)
        run(bpy.ops.throng.add_flow, "EXEC_DEFAULT")
        flow = bpy.context.scene.throng_layout.flows[-1]
        flow.use_end, flow.end = True, ENTERED
        yield 0.5
    view().tag_redraw()
    yield 1
    picture("flows")


def mistake():
    """A flow that goes nowhere."""
    flow = bpy.context.scene.throng_layout.flows[0]
    target = flow.to.place.target
    flow.to.place.target = None
    with in_view():
        try:
            bpy.ops.throng.check()
        except RuntimeError as error:
            print("check:", error, flush=True)
    view().tag_redraw()
    yield 2
    picture("check")
    flow.to.place.target = target
    with in_view():
        assert bpy.ops.throng.check() == {"FINISHED"}
    yield 1


def bake():
    run(bpy.ops.throng.bake, "INVOKE_DEFAULT")
    yield 1
    taken = False
    while bake_operator.running():
        if not taken and bpy.context.scene.throng_layout.progress > 30.0:
            picture("bake")
            taken = True
        yield 0.3
    assert taken and not bpy.context.scene.throng_layout.problems, "everybody is in the crowd"
    yield 2


def crowd():
    bpy.context.scene.frame_set(FRAME)
    view().spaces.active.shading.color_type = "MATERIAL"
    view().spaces.active.region_3d.view_perspective = "CAMERA"
    view().tag_redraw()
    yield 3
    picture("crowd")
    bpy.ops.wm.save_mainfile()


def still():
    """What Preview and Render > Render Image make."""
    scene = bpy.context.scene
    run(bpy.ops.throng.film_look, "EXEC_DEFAULT", preset="preview")
    yield 1
    scene.frame_set(FRAME)
    scene.render.filepath = os.path.join(pictures, "still.jpg")
    for name in dir(scene.render):
        if name.startswith("use_stamp_"):
            setattr(scene.render, name, False)  # pictures carry no paths of the machine
    scene.render.image_settings.file_format, scene.render.image_settings.quality = "JPEG", 85
    bpy.ops.render.render(write_still=True)
    print("picture", scene.render.filepath, flush=True)


def with_one_panel(name):
    """An empty scene, and of the sidebar one panel alone, unfolded."""
    addon_utils.enable("throng", default_set=True)
    yield 2
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    panels = [getattr(bpy.types, name) for name in dir(bpy.types) if name.startswith("VIEW3D_PT_throng_")]
    for each in panels:
        bpy.utils.unregister_class(each)
    shown = next(each for each in panels if each.__name__ == f"VIEW3D_PT_throng_{name}")
    shown.bl_options = set()
    bpy.utils.register_class(shown)


def behaviours():
    """The market, and the panel of its behaviours alone."""
    yield from with_one_panel("behaviours")
    with in_view():
        assert bpy.ops.import_scene.throng_layout(filepath=os.path.abspath("examples/market.json")) == {"FINISHED"}
    behaviour = bpy.context.scene.throng_layout.behaviours[0]
    behaviour.active_state = 1
    yield from open_sidebar()
    settle(4.0, 2.0, 0.0, 45.0, down=60.0, turned=0.0)
    yield 2
    picture("behaviours-visit")
    behaviour.active_state = 0
    yield 2
    picture("behaviours")


def seats():
    """A corner of a stadium is drawn: a straight stand and a curve with openings, and a stand while it is changed."""
    yield from with_one_panel("layout")
    yield from open_sidebar()
    settle(0.8, -15.0, 0.0, 44.0, down=34.0, turned=-155.0)
    cursor(-14.0, -16.0)
    run(bpy.ops.throng.add_seats, "EXEC_DEFAULT", length=28.0, rows=10, aisles=2)
    cursor(0.0, 0.0)
    run(bpy.ops.throng.add_seats, "EXEC_DEFAULT", shape="ARC", radius=16.0, span=math.radians(90.0),
        angle=math.radians(-45.0), rows=12, aisles=3)
    curve = bpy.data.objects["Seats.001"].throng_layout.seats
    curve.height, curve.mouths.at, curve.mouths.row = 0.8, "row", 4
    bpy.data.objects["Seats"].throng_layout.seats.height = 0.8
    view().spaces.active.shading.color_type = "MATERIAL"
    view().spaces.active.overlay.show_floor = True
    view().tag_redraw()
    yield 2
    picture("seats")


PARTS = {"tutorial": (beginning, streets, buildings, flows, mistake, bake, crowd, still), "behaviours": (behaviours,),
         "seats": (seats,)}


def steps():
    for part in PARTS[subject]:
        yield from part()
        yield 1


def drive():
    try:
        return next(going) or 0.5
    except StopIteration:
        status = 0
    except BaseException:
        traceback.print_exc()
        status = 1
    sys.stdout.flush()
    os._exit(status)  # without asking whether to save


bpy.context.preferences.view.show_splash = False
bpy.context.preferences.view.show_developer_ui = False
going = steps()
bpy.app.timers.register(drive, first_interval=3.0)
