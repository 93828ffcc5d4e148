# SPDX-License-Identifier: Apache-2.0
"""What a layout's objects hold, as codecs. Pure Python; a test compares the table of the simulation with the schema."""
from .codecs import Choice, Distribution, Flag, Groups, Nested, Number, Optional, Profile, Whole

METHODS = ("auto", "cones", "gradient1", "gradient2", "gradient2-packed", "per-pixel", "per-site", "jfa", "1+jfa", "jfa+1", "jfa-r", "binned")

# (codec, label, least, most, what it is)
SIMULATION = (
    (Number("duration", 10.0), "Duration", 0.0, 86400.0, "Length of the shot, s"),
    (Number("warmup", 0.0), "Warm-up", 0.0, 3600.0, "Simulated before the first frame and not recorded, s: the shot opens on a crowd that is under way"),
    (Number("fps", 24.0), "Frame Rate", 1.0, 240.0, "Frames a second of the bake"),
    (Whole("substeps", 2), "Substeps", 1, 64, "Simulation steps a frame. More are slower, and keep dense crowds apart more exactly"),
    (Whole("seed", 1), "Seed", 0, 2**31 - 1, "Another seed gives another crowd"),
    (Flag("avoid_congestion", True), "Avoid Congestion", None, None, "Routes lead round jams and prefer streams that go the same way"),
    (Number("smoothing", 0.25), "Smoothing", 0.0, 1.0, "Seconds before and after a frame over which recorded motion is averaged; 0: as simulated"),
    (Number("tile_radius", 0.6), "Tile Radius", 0.05, 10.0, "Radius of a person's tile in the diagram, m: at least the largest body"),
    (Number("field_of_view", 200.0), "Field of View", 0.0, 360.0, "What people see ahead, degrees"),
    (Whole("samples_per_ray", 6), "Samples per Ray", 1, 64, "People see as far as body radius + (samples - 1) x tile radius"),
    (Number("pixels_per_metre", 0.0), "Pixels per Metre", 0.0, 100.0, "Resolution of the diagram; 0: as the smallest tile and body need"),
    (Choice("method", METHODS, "auto"), "Method", None, None, "How the diagram is built; auto takes the fastest exact one"),
    (Whole("cone_sides", 16), "Cone Sides", 3, 256, "Of the method cones"),
    (Choice("proximity", ("voronoi", "grid", "brute"), "voronoi"), "Proximity", None, None, "What finds a person's neighbours"),
    (Whole("neighbours", 10), "Neighbours", 1, 32, "How many nearest people and walls each person heeds"),
    (Number("time_horizon", 2.0), "Time Horizon", 0.1, 20.0, "How far ahead people avoid each other, s"),
    (Number("wall_time_horizon", 0.6), "Wall Time Horizon", 0.05, 20.0, "How far ahead people avoid walls, s"),
    (Number("contact_range", 1.0), "Contact Range", 0.5, 3.0, "People nearer than this are felt whatever the field of view, m"),
    (Whole("contact_iterations", 8), "Contact Iterations", 1, 32, "Rounds a step of keeping bodies out of each other"),
    (Number("maximum_acceleration", 4.0), "Maximum Acceleration", 0.1, 100.0, "Highest change of velocity that a person wants, m/s^2"),
)

BARS = ("arrived", "stuck", "refused", "seconds", "overlapping_percent", "deepest_overlap_percent", "wall_crossings", "deepest_wall_penetration",
        "time_ratio", "detour_ratio", "heading_rate_p99", "acceleration_p99", "backward_percent", "effort", "lane_order", "mean_speed", "high_density",
        "flow")

BAR = (Optional(Number("min", 0.0, "least")), Optional(Number("max", 0.0, "most")))

PEOPLE = (Distribution("speed"), Distribution("radius"), Number("maximum_speed_factor", 1.4), Number("headway", 0.0), Profile("profile", "profile_weights"),
          Distribution("reaction"), Groups("groups", "group_weights"))

ROAD = (Number("width", 3.0), Flag("one_way"))
OPEN_WALL = (Number("thickness", 0.2), Number("height", 3.0))
CLOSED_WALL = (Number("height", 3.0),)

FLOW = (Number("start", 0.0), Optional(Number("end", 60.0)), Nested("people", PEOPLE), Choice("arrival", ("leave", "stay"), "leave"))

STOP = (Distribution("wait"), Choice("activity", ("gather", "look", "queue"), "gather"), Number("spacing", 0.8))

_STANDING = (Number("start", 0.0), Distribution("wait"), Nested("people", PEOPLE), Choice("arrival", ("leave", "stay"), "stay"),
             Number("goal_tolerance", 0.3))
FORMATION = {
    "circle": (Number("radius", 10.0, required=True), Whole("count", 64, required=True), Optional(Number("ring_spacing", 1.5)),
               Optional(Number("along", 1.5))) + _STANDING,
    "grid": (Whole("rows", 8, required=True), Whole("columns", 8, required=True), Optional(Whole("count", 64, "people_count")), Number("spacing", 1.0),
             Number("jitter", 0.0)) + _STANDING,
    "agents": _STANDING,
}

