// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "authoring/behaviour.h"
#include "authoring/destination.h"
#include "authoring/diagram_method.h"
#include "authoring/distribution.h"
#include "authoring/expectation.h"
#include "authoring/source_position.h"
#include "authoring/traffic.h"
#include "base/motion_settings.h"

/// What a layout file says, checked but not yet interpreted. World coordinates: metres, double precision,
/// X east, Y north, Z up. Angles in degrees, counter-clockwise from +X. Times in seconds from the first
/// frame.
namespace throng::authoring {

/// A body that is no disc: from shoulder to shoulder, and from chest to back, m.
struct BodySides {
    Distribution breadth, depth;
    bool operator==(const BodySides&) const = default;
};

/// How a person differs from the next. Speeds in m/s, lengths in metres.
struct PersonSettings {
    /// Preferred walking speed, 0.05 to 10 m/s. Free walking of adults: mean 1.34, deviation 0.26 (Weidmann
    /// 1993).
    Distribution speed{Distribution::Kind::normal, 1.34, 0.26, 0.6, 2.2};
    /// Body radius, 0.1 to 1 m: half the shoulder breadth.
    Distribution radius{Distribution::Kind::uniform, 0.25, 0.0, 0.22, 0.28};
    /// In place of the radius; none: a disc.
    std::optional<BodySides> body;
    /// Highest speed as a multiple of the preferred one, 1 to 3.
    double maximum_speed_factor = 1.4;
    /// s, 0 to 5: the free way kept to those walked behind. 0: people press on.
    double headway = 0.0;
    /// s, 0 to 3600: how long it takes to set off when an event sends people somewhere else.
    Distribution reaction;

    double largestRadius() const {
        return body ? 0.5 * std::max(body->breadth.maximum, body->depth.maximum) : radius.maximum;
    }
};

/// A kind of people and how large its share is.
struct PeopleShare {
    double weight = 1.0;
    PersonSettings settings;
    std::string profile = {};  ///< its name; empty: the layout names none
};

/// Larger groups of friends split up into twos and threes (Moussaid et al. 2010).
inline constexpr std::size_t kLargestParty = 4;

/// Who walks: at least one kind.
struct People {
    std::vector<PeopleShare> kinds{PeopleShare{}};
    /// Weights of social groups of one, two, three and four people who walk together.
    std::array<double, kLargestParty> party_sizes{1.0, 0.0, 0.0, 0.0};
    std::string look = "casual";       ///< what they wear
    std::vector<std::string> colours;  ///< two of fans, "#rrggbb"; empty: the look's own
    double largestRadius() const {
        double largest = 0.0;
        for (const PeopleShare& share : kinds)
            largest = std::max(largest, share.settings.largestRadius());
        return largest;
    }
};

/// What finds a person's neighbours.
enum class Proximity {
    voronoi,  ///< rays through the truncated Voronoi diagram
    grid,     ///< the cells around the person (a spatial hash without collisions)
    brute,    ///< everybody
};

struct SimulationSettings {
    double duration = 10.0;            ///< s, (0, 86400]: the length of the shot
    double warmup = 0.0;               ///< s, [0, 3600]: simulated before the first frame and not recorded
    double fps = 24.0;                 ///< frames/s, [1, 240]: the shot's frame rate
    int substeps = 2;                  ///< simulation steps per frame, [1, 64]
    double decision_interval = 0.084;  ///< s, [0, 0.25]: the longest from one decision of people to the next
    std::uint64_t seed = 1;            ///< [0, 2^53]: same layout, seed and driver give the same bytes
    double tile_radius =
        0.6;  ///< m, [0.05, 10]: a site's tile in the diagram; at least the largest body radius
    double field_of_view = 200.0;  ///< degrees, (0, 360]: what a person sees ahead
    int samples_per_ray = 6;       ///< [1, 64]: reach R = a + (samples - 1) * tile radius
    double pixels_per_metre =
        0.0;  ///< px/m, 0 = one pixel per smallest body radius; (0, 100]: diagram resolution
    SourcePosition pixels_per_metre_where;
    DiagramMethod method = DiagramMethod::automatic;
    int cone_sides = 16;                       ///< [3, 256]: sides of a cone, method cones only
    Proximity proximity = Proximity::voronoi;  ///< what neighbours are found with
    int neighbours = 10;                       ///< [1, 32]: nearest sites kept by each person
    double time_horizon = 2.0;                 ///< s, [0.1, 20]: how far ahead people avoid each other
    double wall_time_horizon = 0.6;            ///< s, [0.05, 20]: how far ahead people avoid walls
    double contact_range = 1.0;  ///< m, [0.5, 3]: those nearer than this are felt whatever the field of view
    int contact_iterations = 8;  ///< [1, 32]: rounds per step that keep bodies apart
    /// s, [0, 1]: what is recorded is averaged over nearly as much before and after (recording/); 0: not at
    /// all
    double smoothing = 0.25;
    bool ends_when_empty = false;  ///< the bake is shorter where everybody has left before its end
    bool walls_hide = false;       ///< nobody makes room for those behind walls that cannot be looked over
    bool avoid_congestion = true;  ///< routes lead round jams, as far as people could see them coming
    double maximum_acceleration = 4.0;  ///< m/s^2, [0.1, 100]
    MotionSettings motion;              ///< the layout's `motion`

    /// Steps from one decision to the next: whole frames, or where not even one fits the interval, an equal
    /// share of a frame's steps.
    int stepsPerDecision() const {
        const int whole_frames = static_cast<int>(decision_interval * fps + 1e-9);
        if (whole_frames > 0) return whole_frames * substeps;
        int steps = 1;
        for (int each = 2; each <= substeps; ++each)
            if (substeps % each == 0 && each <= decision_interval * fps * substeps + 1e-9) steps = each;
        return steps;
    }
};

/// A floor; levels may lie above each other.
struct Level {
    std::string id;
    double height = 0.0;            ///< m
    std::vector<glm::dvec2> floor;  ///< simple, any winding, not closed by a repeated point
    SourcePosition where;
    std::optional<glm::dvec3> at{};  ///< m: a place on it, of a part of a terrain, which has no floor
    bool is_landing = false;         ///< of a link that turns; nothing but people is on it
};

/// What a link is that is a cabin going up and down.
struct Lift {
    std::vector<std::size_t> levels;  ///< where it stops, index into levels
    std::vector<bool> opposite;       ///< of each of these: whether its doors are on the other side there
    glm::dvec2 at{0.0};               ///< m, the cabin's middle
    glm::dvec2 size{1.6, 1.4};        ///< m: along its doors, and away from them
    double doors = 0.0;               ///< degrees: which way out of the cabin they open
    double door_width = 1.0;          ///< m
    double door_time = 2.0;           ///< s, to open or to close
    double dwell = 3.0;               ///< s: the least that doors are open, also after the last has come in
    double speed = 1.0;               ///< m/s
    std::optional<std::uint32_t> capacity;  ///< none: as many as there is room for
    std::vector<double> heights{};  ///< m, of the ground before its doors, if its levels are not level
};

/// A straight way between two levels, with a railing on either side, or a lift.
struct Link {
    enum class Kind { stairs, ramp, escalator, travelator, lift };
    enum class Stand { anywhere, right, left };
    std::string id;
    Kind kind = Kind::stairs;
    std::size_t from = 0, to = 0;  ///< index into levels; the same only of a travelator
    glm::dvec2 begin{0.0}, end{0.0};
    double width = 2.0;  ///< m, between the railings; of the steps of what moves
    SourcePosition where;
    double speed = 0.5;             ///< m/s along its slope, of ground that moves
    double walking = 0.4;           ///< share of its people who walk on it
    Stand stand = Stand::anywhere;  ///< on which side those stand who do not

    Lift lift{};                          ///< of that kind
    std::optional<glm::dvec2> heights{};  ///< m, where it begins and ends, if its levels are not level

    bool isLift() const { return kind == Kind::lift; }
    /// Whether its ground moves, from where it begins to where it ends.
    bool moves() const { return kind == Kind::escalator || kind == Kind::travelator; }
};

struct Road {
    std::string id;
    std::vector<glm::dvec2> centreline;  ///< at least two points
    double width = 3.0;                  ///< m
    bool one_way = false;                ///< true: walked from the centreline's first point to its last only
    SourcePosition where;
    std::size_t level = 0;  ///< that it lies on, index into levels if there are any
};

struct Area {
    std::string id;
    std::vector<glm::dvec2> polygon;  ///< simple, any winding, not closed by a repeated point
    SourcePosition where;
    std::size_t level = 0;
    std::optional<glm::dvec2> facing{};  ///< what those look at whom a behaviour brings there
};

struct Wall {
    std::string id;
    std::vector<glm::dvec2> points;
    bool closed = false;     ///< true: a solid polygon; nobody is inside it
    double thickness = 0.2;  ///< m, open walls only
    double height = 3.0;     ///< m over the highest ground along it, for the exported meshes
    SourcePosition where;
    bool open_at_start = false;     ///< a gate that is closed later
    std::vector<double> toggles{};  ///< s, increasing: when events open or close it, in turn
    std::size_t level = 0;
    bool is_edge = false;  ///< where a terrain ends: not to be seen
    bool isOpen(double time) const {
        const auto passed =
            std::count_if(toggles.begin(), toggles.end(), [&](double at) { return at <= time; });
        return open_at_start != (passed % 2 == 1);
    }
};

/// m: nobody looks over what is higher.
inline constexpr double kSeenOver = 1.5;

/// Ground that people would rather not walk on, walk on at another pace, or take another room on.
struct Patch {
    std::string id;
    std::vector<glm::dvec2> polygon;  ///< simple, any winding, not closed by a repeated point
    SourcePosition where;
    double cost = 1.0;              ///< m of another way that a metre of it is worth
    double pace = 1.0;              ///< times the preferred speed
    double size = 1.0;              ///< times how broad and deep bodies are by themselves
    double from = 0.0;              ///< s; 0: always, also in the warm-up
    std::optional<double> until{};  ///< s; none: to the end
    std::size_t level = 0;
    bool isForATime() const { return from > 0.0 || until.has_value(); }
};

/// A mesh that people stand on, and how it lies in the layout: world = offset + scale * (x, -z, y) of the
/// file.
struct TerrainSettings {
    std::string file;  ///< as the layout has it: relative to the layout's folder
    std::string node;  ///< only nodes or meshes of this name; empty = all
    glm::dvec3 offset{0.0};
    double scale = 1.0;
    bool highest = true;     ///< of several surfaces above each other; otherwise the lowest
    bool is_single = false;  ///< the layout says which of them: then the others are nobody's ground
    SourcePosition where, file_where, node_where;
};

enum class Arrival { leave, stay };

/// s: two people of a flow that tells its gaps never come nearer to each other than this.
inline constexpr double kLeastGap = 1.0e-3;

struct Flow {
    std::string id;
    Place from;
    std::vector<BehaviourState> via;  ///< stops: those without `lasts` are passed through
    Destination to;
    std::optional<std::uint64_t> count;  ///< people in all, spread evenly over [start, end]
    std::optional<double> rate;          ///< people per second (Poisson arrivals, seeded)
    std::optional<Distribution> gaps{};  ///< s from one to the next
    std::vector<double> times{};         ///< s, ascending; exactly one of count, rate, gaps and times is told
    double start = 0.0;                  ///< s
    double end = 0.0;                    ///< s; the reader fills in the duration where the file says nothing
    People people;
    Arrival arrival = Arrival::leave;
    SourcePosition where;
    std::optional<std::size_t> behaviour{};  ///< in place of `via` and `to`
    std::optional<AtPlatform> alights{};  ///< they get off there, `count` of each vehicle: in place of `from`
    std::optional<AtPlatform> boards{};   ///< they get on there: in place of `to`
};

/// A straight line between two points: to mirror at, or to count people across.
struct Line {
    glm::dvec2 a{0.0};
    glm::dvec2 b{0.0};
};

/// Two opposite corners.
struct Extent {
    glm::dvec2 a{0.0};
    glm::dvec2 b{0.0};
};

struct CircleFormation {
    glm::dvec2 centre{0.0};
    double radius = 10.0;
    std::uint64_t count = 0;    ///< evenly spaced; everybody's goal is the diametrically opposite point
    double ring_spacing = 0.0;  ///< m: further rings outside, this far apart; 0 = one ring for all
    double along = 0.0;         ///< m: between neighbours on a ring, where there are several
};

struct GridFormation {
    glm::dvec2 origin{0.0};     ///< centre of the first row's first person
    std::uint64_t rows = 1;     ///< along the grid's own +Y
    std::uint64_t columns = 1;  ///< along the grid's own +X
    double spacing = 1.0;       ///< m
    double jitter = 0.0;        ///< m: each coordinate moves by up to this much, uniformly
    double rotation = 0.0;      ///< degrees about the origin point
    std::uint64_t count = 0;    ///< people, column by column from the first; 0 = all rows and columns
    /// An offset added to each person's position, a place, a line at which each position is mirrored, or
    /// anywhere in a box.
    std::variant<glm::dvec2, Destination, Line, Extent> goal;
};

/// A place on the way of somebody who is listed.
struct Waypoint {
    glm::dvec2 point{0.0};
    double wait = 0.0;  ///< s that the person stands there; 0: it only passes
    SourcePosition where{};
};

struct ListedAgent {
    glm::dvec2 position{0.0};
    glm::dvec2 goal{0.0};
    std::optional<double> speed;    ///< m/s; otherwise drawn
    std::optional<double> radius;   ///< m; otherwise drawn
    std::optional<double> heading;  ///< degrees; otherwise towards the first place of its way
    SourcePosition where;
    std::vector<Waypoint> via{};      ///< in order, before the goal
    double start = 0.0;               ///< s: when the person appears
    std::optional<double> wait{};     ///< s before it sets off; otherwise drawn
    std::optional<Destination> to{};  ///< in place of the goal
};

struct ListFormation {
    std::vector<ListedAgent> agents;  ///< in the order of their starts
};

struct Formation {
    std::string id;
    std::variant<CircleFormation, GridFormation, ListFormation> shape;
    double start = 0.0;  ///< s: when they appear
    Distribution wait;   ///< s: how long they stand before they set off
    People people;
    Arrival arrival = Arrival::stay;
    double goal_tolerance = 0.3;  ///< m: this near a point goal is arrived
    std::size_t level = 0;
    SourcePosition where;
    std::optional<std::size_t> behaviour{};  ///< in place of goals
};

/// Where somebody is whose way is given, and when.
struct GivenPoint {
    double time = 0.0;  ///< s
    glm::dvec2 place{0.0};
    std::optional<double> height{};  ///< m: which ground it is on, where there are several
    bool operator==(const GivenPoint&) const = default;
};

/// People who follow ways that are given, whatever is in them; others make room for them.
struct GivenPeople {
    std::string id;
    std::string file;                             ///< relative to the layout; empty: the layout has the ways
    std::optional<double> fps{};                  ///< frames/s of the file, where it does not say so
    double start = 0.0;                           ///< s: added to its times
    glm::dvec2 offset{0.0};                       ///< m: added to its places
    std::vector<std::vector<GivenPoint>> ways{};  ///< each of two points or more, in the order of their times
    People people;
    std::size_t level = 0;
    SourcePosition where, file_where{};
};

/// Rows of seats, one behind the other. People look to the left of the first row, from its first point to its
/// last, unless there is something to look at.
struct SeatBlock {
    std::string id;
    std::vector<glm::dvec2> front;  ///< the first row, at least two points; of an arc, finely enough
    std::uint64_t rows = 1;
    double pitch = 0.8;   ///< m from row to row
    double width = 0.5;   ///< m of a seat
    double rise = 0.0;    ///< m that each row is higher than the one before it
    double height = 0.0;  ///< m, of the first row
    std::optional<glm::dvec2> facing;
    std::uint64_t aisles = 0;  ///< through all rows, at even distances
    double aisle_width = 1.2;  ///< m
    double occupancy = 1.0;    ///< share of the seats
    /// Where its aisles go out to the ground.
    struct Mouths {
        enum class At {
            front,  ///< before the first row
            back,   ///< behind the last one
            row,    ///< through an opening in the stand (a vomitory), and a passage under the rows behind it
        };
        At at = At::front;
        std::uint64_t row = 1;  ///< the first one is 1; people come out on it
        std::optional<double>
            passage;            ///< m in plan, from the opening to its foot; none: to behind the block
        std::size_t level = 0;  ///< of the foot
        double height = 0.0;    ///< m, of the ground there
        SourcePosition where{};
    };
    Mouths mouths{};
    std::size_t level = 0;  ///< that the stand keeps people off
    /// Each row goes up and down with the terrain along it, and heights count over that.
    bool on_terrain = false;
    /// m, of the terrain at a place; NaN where there is none. Null: there is none at all
    /// (authoring/scene/seat_ground.h).
    std::function<double(glm::dvec2)> ground{};
    glm::dvec2 shift{0.0};  ///< m: place in the plane - home (authoring/storeys)
    People people;
    SourcePosition where;
    /// People walk to its seats or leave them: what those do who sit in it from the beginning. None: they
    /// only ever sit there, and are not simulated.
    std::optional<std::size_t> behaviour{};
    bool isOpen() const { return behaviour.has_value(); }
};

/// What an audience does, from a time on.
struct Show {
    enum class Kind { clap, cheer, sing, wave };
    Kind kind = Kind::clap;
    Distribution at;                  ///< s: everybody's own, so that it may be a window
    std::vector<std::size_t> blocks;  ///< of seats; a wave runs along them in this order
    double share = 1.0;               ///< of the people there
    Distribution lasts{Distribution::Kind::constant, 6.0, 0.0, 6.0, 6.0};  ///< s; not of a wave
    /// s, [0, 60]: median 0.3, right-skewed, as times of reaction are (Luce 1986).
    Distribution reaction{Distribution::Kind::log_normal, -1.2, 0.4, 0.0, 60.0};
    double speed = 12.0;             ///< wave: m/s along the middle row (Farkas, Helbing and Vicsek 2002)
    double width = 15.0;             ///< wave: seats
    std::optional<glm::dvec2> from;  ///< wave: it begins at the seat nearest to it
    std::uint64_t laps = 1;          ///< wave
    SourcePosition where;
};

/// Something that happens at a time.
struct Event {
    enum class Kind {
        open,   ///< a wall is gone from now on
        close,  ///< a wall is there from now on
        go_to,  ///< people set off to somewhere else
        rate,   ///< a flow brings more or fewer people from now on
    };
    Kind kind = Kind::go_to;
    double at = 0.0;               ///< s
    std::size_t subject = 0;       ///< open, close: index into walls; rate: into flows
    double rate = 0.0;             ///< persons/s
    BehaviourState then;           ///< go_to: what they do from now on
    std::vector<std::string> who;  ///< go_to: ids of flows and formations; empty = everybody
    SourcePosition where;
};

/// What draws people's eyes.
struct Attraction {
    std::string id;
    glm::dvec2 at{0.0};
    double height = 1.6;  ///< m, over the ground there
    double weight = 1.0;  ///< how much it draws eyes: somebody in one's company draws 1
    double reach = 15.0;  ///< m: who is further away does not mind it
    double from = 0.0;    ///< s
    std::optional<double>
        until;          ///< s; none: to the end, or, of what is loud, no longer than heads turn to it
    bool loud = false;  ///< everybody in reach turns to it when it begins
    std::size_t level = 0;
    SourcePosition where;
};

struct Layout {
    std::string name;
    SimulationSettings simulation;
    std::vector<Level> levels;  ///< none: one ground without an end
    std::vector<Link> links;
    std::vector<Road> roads;
    std::vector<Area> areas;
    std::vector<Wall> walls;
    std::vector<Patch> patches;
    std::optional<TerrainSettings> terrain;  ///< none: flat ground at height 0
    std::vector<Behaviour> behaviours;
    std::vector<Flow> flows;
    std::vector<Formation> formations;
    std::vector<GivenPeople> given;
    std::vector<Event> events;  ///< in the order of their times
    std::vector<SeatBlock> seats;
    std::vector<Show> shows;
    std::vector<Attraction> attractions;
    Traffic traffic;
    std::vector<Expectation> expectations;
    std::optional<Line> flow_line;  ///< across which people are counted for the bar on `flow`
};

}  // namespace throng::authoring
