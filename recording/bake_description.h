// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "authoring/layout.h"
#include "authoring/terrain/terrain.h"
#include "authoring/terrain/terrain_mesh.h"
#include "base/activities.h"
#include "base/capsule.h"
#include "base/door_track.h"
#include "base/stream_formats.h"
#include "base/streams.h"
#include "base/vehicle_track.h"

namespace throng::recording {

/// A flow or a formation of the layout.
struct BakeGroup {
    std::string id;
    bool is_flow = false;
    bool is_given = false;     ///< its people follow given ways
    std::string look = {};     ///< what its people wear
    std::string colours = {};  ///< of fans: two, apart by a space; empty: the look's own
};

/// What is known of a row before the simulation begins.
struct BakeAgent {
    std::uint32_t group = 0;       ///< index into BakeDescription::groups
    float radius = 0.0f;           ///< m
    float preferred_speed = 0.0f;  ///< m/s
    std::uint32_t variation = 0;
    std::uint32_t party = 0;  ///< row of the first of those it walks with; its own where it walks alone
    glm::dvec2 goal{0.0};     ///< m, world
    double scale = 1.0;       ///< of the figure, beyond what the radius says
    std::optional<std::uint32_t> colour = {};  ///< 0xRRGGBB, instead of the group's
    BodySize body = {};                        ///< where it is no disc; `radius` is that of the figure then
    std::string profile = {};                  ///< as the layout names it; empty: it names none
};

/// Somebody who has a seat, in the frame of reference of the frames.
struct BakeSpectator {
    glm::vec2 place{0.0f}, ahead{1.0f, 0.0f};
    float height = 0.0f;  ///< m
    std::uint32_t variation = 0;
    std::vector<Deed> deeds;  ///< in the order of their times
};

/// Somebody who is simulated and has a seat, and what it is to do in shows while it sits there.
struct BakeSitter {
    std::uint32_t row = 0;
    std::vector<SeatCue> cues;  ///< in the order of their times
};

/// A line of seats from aisle to aisle, for whoever shows it.
struct BakeSeatRow {
    std::vector<glm::dvec2> line;      ///< m, in the middle of the seats
    double height = 0.0;               ///< m, of the floor before them; on a terrain the lowest
    std::vector<double> heights = {};  ///< m, on a terrain, of each point
};

/// Something that draws eyes, in the frame of reference of the frames.
struct EyeCatcher {
    glm::dvec2 place{0.0};
    double height = 1.6;  ///< m, of what is looked at, as those of the ground
    double weight = 1.0;
    double reach = 15.0;                ///< m
    double from = 0.0, until = 1.0e30;  ///< s
    bool loud = false;                  ///< it is heard when it begins
    bool is_audience = false;           ///< that cheers: nobody in a seat turns to it
    std::optional<double> storey =
        {};  ///< m: nobody sees it but from a floor of this height; none: there are no floors
};

/// Something that people walk on in a stand.
struct BakeFlight {
    std::vector<glm::dvec2> line;  ///< m, its middle
    std::vector<double> heights;   ///< m, one for each point
    double width = 1.2;            ///< m
};

/// Steps between rows of seats that people walk to, for whoever shows them.
struct BakeAisle {
    std::vector<glm::dvec2> line;  ///< m, its middle: on the ground before the block, and before each row
    double width = 1.2;            ///< m
    /// Of an aisle that goes out behind its block or through an opening: what is before it, what is behind
    /// it, and what is beside it; a point before each row. Its `line` is that of its passage then.
    std::vector<BakeFlight> flights = {};
    std::optional<BakeFlight> passage = {};  ///< from its foot to the row on which it comes out
    std::vector<double> heights = {};        ///< m, on a terrain, of each point
};

/// A block of seats.
struct BakeSeats {
    std::string id;
    double pitch = 0.8, width = 0.5, rise = 0.0;  ///< m
    std::vector<BakeSeatRow> rows;
    std::vector<BakeAisle> aisles = {};  ///< empty: nobody walks to its seats or leaves them
    std::optional<double> ground = {};   ///< m, on a terrain: the lowest of it there
};

/// What the layout was made from.
struct LayoutSource {
    std::string file;  ///< its name; empty: it came from no file
    std::string hash;  ///< of its bytes
    std::vector<std::string> overrides;
};

/// Ground that is not flat.
struct BakeTerrain {
    std::shared_ptr<const authoring::TerrainMesh> mesh;
    std::shared_ptr<const authoring::Terrain> surface;  ///< in the frame of reference of the frames
    std::string source;                                 ///< the file, as the layout names it
    std::string hash;                                   ///< of that file
    std::vector<glm::dvec2> along_walls;  ///< per wall, the lowest and the highest ground along it, m
    bool is_cut = false;                  ///< people walk on several of its faces above each other
};

/// How the simulation's plane and the places of a layout with levels belong together
/// (authoring/storeys/charts.h).
struct BakeCharts {
    std::vector<glm::dvec2> shifts;      ///< m, by chart: place in the plane - home
    std::vector<glm::dvec2> belts = {};  ///< m/s, by chart: how its ground moves; empty: none does
    struct Cabin {
        std::size_t lift = static_cast<std::size_t>(-1);  ///< of a chart that is none: that
        float height = 0.0f;                              ///< m
    };
    std::vector<Cabin> cabins = {};  ///< by chart; empty: there are no lifts

    /// What a picture of one of them has to say.
    struct Picture {
        std::string name;                    ///< as the layout has it, and no other picture
        std::string kind;                    ///< "level", "link", "lift" or "ground"
        std::string level;                   ///< on which it is; of a link, that from which it leads
        glm::dvec2 lower{0.0}, upper{0.0};   ///< m, world: all that its people own
        double lowest = 0.0, highest = 0.0;  ///< m, of its ground
    };
    std::vector<Picture> pictures = {};  ///< by chart; empty: nobody asks for any
    /// Whose part of the plane a cell is, and whose ground it shows, in the frame of reference of the frames.
    struct Cells {
        glm::vec2 minimum{0.0f};
        float size = 0.25f;  ///< m
        std::uint32_t width = 0, height = 0;
        std::vector<std::uint16_t> charts;  ///< byte 0 the chart whose part it is, byte 1 that of the ground
    };
    Cells cells = {};  ///< with pictures
};

/// All that a bake's files say besides the frames. World coordinates unless told otherwise; metres and
/// seconds.
struct BakeDescription {
    std::filesystem::path output;  ///< the folder to make
    bool force = false;            ///< replace an existing bake
    bool ends_when_empty = false;  ///< there may be fewer frames than expected, and all are there

    std::string name;         ///< the layout's
    std::string layout_text;  ///< the layout as it is baked: its file's bytes where nothing overrides them
    LayoutSource source;
    std::string inputs;  ///< hash of all that the bytes depend on; empty: not told
    std::uint64_t seed = 1;
    double fps = 24.0;
    std::uint32_t frames = 0;  ///< expected
    std::uint32_t substeps = 1;
    double duration = 0.0;
    double warmup = 0.0;
    double smoothing = 0.0;  ///< s, SimulationSettings::smoothing
    std::uint32_t variations = 1;
    std::vector<double> strides{1.446};  ///< m per cycle of each gait

    glm::dvec2 scene_origin{0.0};   ///< world = scene_origin + what the frames hold
    glm::dvec2 output_origin{0.0};  ///< world = output_origin + what the streams hold
    glm::dvec2 minimum{0.0};        ///< bounds of all that people can reach
    glm::dvec2 maximum{0.0};

    /// Makes places of frames, all components, into those that the streams hold.
    void toOutput(std::span<float> places) const {
        const glm::dvec2 shift = scene_origin - output_origin;
        for (std::size_t at = 0; at < places.size(); at += kComponents) {
            places[at] = static_cast<float>(places[at] + shift.x);
            places[at + 1] = static_cast<float>(places[at + 1] + shift.y);
        }
    }

    std::vector<BakeGroup> groups;
    std::vector<BakeAgent> agents;        ///< one per row
    std::vector<BakeSpectator> audience;  ///< of the last rows: they are not simulated
    std::vector<BakeSeats> seats;
    std::vector<BakeSitter> sitters;  ///< those who take part in shows
    bool has_poses = false;           ///< of those who are simulated, some sit, or do things with their hands
    std::vector<EyeCatcher> eye_catchers;  ///< in the frame of reference of the frames
    std::vector<authoring::Road> roads;
    std::vector<authoring::Area> areas;
    std::vector<authoring::Patch> patches;
    std::vector<authoring::Wall> walls;
    authoring::Traffic traffic;  ///< where lanes, crossings and signals are
    std::vector<VehicleIdentity> vehicles;
    /// The ground under a vehicle where ground is cut into charts.
    struct VehicleGround {
        glm::dvec2 shift{0.0};              ///< m, from home to the frame of reference of the track
        glm::dvec2 lower{0.0}, upper{0.0};  ///< m, likewise: beyond, it is as high as at its edge
    };
    std::vector<VehicleGround> vehicle_grounds;  ///< per vehicle; empty: the ground is one
    std::vector<DoorIdentity> doors;             ///< per vehicle; empty: none has any that are used
    std::optional<BakeTerrain>
        terrain;  ///< none: flat ground at height 0; floors and links of layouts with levels
    std::vector<authoring::Level> levels;
    std::vector<authoring::Link> links;
    std::vector<authoring::Link> lifts;
    std::optional<BakeCharts> charts;  ///< with levels: then frames hold, behind places in the plane, charts

    std::string renderer;  ///< GL_RENDERER
    std::string driver;    ///< GL_VERSION

    bool gltf = true;
    std::uint32_t gltf_agents = 2000;  ///< at most this many people in crowd.glb; the rest is left out
    std::uint32_t diagram_every = 0;   ///< frames between diagram images; 0 = none
    StreamChoice asked{};              ///< the streams from the device that are written, too
    StreamFormats formats = StreamFormats::standard();  ///< in which all streams are written

    StreamChoice streams() const { return streamsOf(terrain.has_value(), asked); }
    std::size_t walkers() const { return agents.size() - audience.size(); }
};

}  // namespace throng::recording
