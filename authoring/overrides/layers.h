// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "authoring/overrides/overrides.h"

/// Changes to whoever a selector means, one layer after the other: each sees the crowd as those before it
/// have left it. Metres, world coordinates, degrees counter-clockwise, frames from 0.
namespace throng::authoring {

/// Both ends are among them.
struct FrameRange {
    std::uint32_t first = 0;
    std::uint32_t last = std::numeric_limits<std::uint32_t>::max();

    bool holds(double frame) const { return frame >= first && frame <= last; }
};

struct Selector;

struct Everybody {};
/// Who has been changed by an override or by a layer before.
struct Changed {};
/// One of these words stands in somebody's column, or is the layer that somebody is a copy of.
struct Named {
    enum class Of { group, profile, look, copies } of = Of::group;
    std::vector<std::string> names;
};
struct PartySize {
    std::uint32_t least = 1, most = 1;
};
struct Rows {
    std::uint32_t first = 0, last = 0;
};
/// Found as the people of overrides are.
struct ListedPeople {
    std::vector<Override> people;
};
struct Region {
    std::vector<glm::dvec2> polygon;
    FrameRange frames;
};
struct Share {
    double of = 0.0;
    std::uint64_t seed = 0;
};
/// Where a camera is from a frame on.
struct View {
    std::uint64_t frame = 0;
    std::array<double, 16> matrix{};   ///< to the world, row by row; the camera looks along its -z
    glm::dvec2 size{1.0}, shift{0.0};  ///< m, of the picture 1 m away
    bool parallel = false;
};
struct Seen {
    std::vector<View> views;  ///< by frame
    FrameRange frames;
    double margin = 0.5, range = 1.0e6;  ///< m
};
struct Near {
    std::optional<glm::dvec2> point;
    std::string wall;
    std::vector<Selector> who;  ///< one, or none
    double within = 0.0;
    FrameRange frames;
};
/// Whom all, any or none of some selectors mean, or whoever walks with those whom one means.
struct Combined {
    enum class By { all, any, none, company } by = By::all;
    std::vector<Selector> parts;
};

struct Selector {
    SourcePosition where;
    std::variant<Everybody, Changed, Named, PartySize, Rows, ListedPeople, Region, Share, Seen, Near,
                 Combined>
        what;
};

/// What the stream of states says somebody does; the numbers are that stream's.
enum class ClipActivity { walks = 1, stands = 2, looks = 3, queues = 4 };

struct Clip {
    ClipActivity activity = ClipActivity::walks;
    FrameRange frames;
};

struct LookAt {
    std::optional<glm::dvec3> point;
    std::optional<Override> person;
    FrameRange frames;
    double ease = 12.0;  ///< frames
};

struct Duplicate {
    std::uint64_t copies = 1;
    PersonChange each;  ///< move, turn and delay: of the n-th copy, n times
    std::optional<glm::dvec2> about;
    double scatter = 0.0;  ///< m
    std::uint64_t seed = 0;
};

struct BendPoint {
    double at = 0.0;  ///< frame, or m walked since the entry
    glm::dvec2 by{0.0};
};

struct Bend {
    bool by_way = false;
    std::vector<BendPoint> points;   ///< in order
    std::optional<double> falloff;   ///< frames or m
    double most_acceleration = 1.0;  ///< m/s^2
};

/// What a layer does to each, in this order.
struct Operations {
    PersonChange change;  ///< of these, retime first, then the bend, then all the rest
    std::optional<Bend> bend;
    std::optional<glm::dvec2> about;  ///< what all are turned about
    std::optional<FrameRange> hidden;
    std::optional<Clip> clip;
    std::optional<LookAt> look_at;
    std::optional<Duplicate> duplicate;  ///< last

    bool changesNothing() const {
        return change.changesNothing() && !bend && !hidden && !clip && !look_at && !duplicate;
    }
};

struct Layer {
    SourcePosition where;
    std::string name;
    bool enabled = true;
    Selector who;
    Operations operations;
};

/// "hide", "move", ...: what a layer does, in words.
std::vector<std::string> operationWords(const Operations& operations);

}  // namespace throng::authoring
