// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "authoring/family/generate.h"

namespace throng::authoring::generate {
namespace {

Json area(const std::string& id, const std::string& level, const Json& polygon) {
    return {{"id", id}, {"level", level}, {"polygon", polygon}};
}

/// As few as there are still come.
Json flow(const std::string& id, const std::string& from, const Json& to, std::uint64_t count, double end) {
    return {{"id", id}, {"from", from}, {"to", to}, {"count", count}, {"end", std::max(end, 0.05)}};
}

// m
constexpr double kDeckRise = 5.5, kStairsRun = 10.0, kBelt = 9.5, kTracks = 8.0, kEnds = 2.0,
                 kStationGate = 3.0;
constexpr double kStairsAt = 12.0, kBeltAt = 26.0;  // from the middle of a platform to their upper ends

/// Platforms over a concourse.
class Station {
  public:
    explicit Station(const GeneratorValues& values)
        : values_(values),
          count_(values.whole("platforms")),
          width_(std::max(values["platform_width"], values["stairs"] + 2.8)),
          half_(0.5 * values["length"]) {
        depth_ = static_cast<double>(count_) * width_ + static_cast<double>(count_ - 1) * kTracks;
    }

    Json make() const {
        Json layout = frameOf("station", values_);
        layout["levels"].push_back(
            {{"id", "concourse"}, {"floor", rectangle(-half_, -kEnds, half_, depth_ + kEnds)}});
        for (std::uint64_t i = 0; i < count_; ++i)
            addPlatform(layout, i);
        const double middle = 0.5 * depth_, reach = 0.5 * std::min(depth_, 12.0);
        for (const auto& [id, x] :
             {std::pair{"west", -half_ + 0.5}, std::pair{"east", half_ - 0.5 - kStationGate}})
            layout["areas"].push_back(
                area(id, "concourse", rectangle(x, middle - reach, x + kStationGate, middle + reach)));
        for (std::uint64_t i = 0; i < count_; ++i)
            addPeople(layout, i);
        return layout;
    }

  private:
    static std::string nameOf(std::uint64_t i) { return fmt::format("platform {}", i + 1); }
    double lowerOf(std::uint64_t i) const { return static_cast<double>(i) * (width_ + kTracks); }

    void addPlatform(Json& layout, std::uint64_t i) const {
        const double low = lowerOf(i), y = low + 0.5 * width_;
        layout["levels"].push_back({{"id", nameOf(i)},
                                    {"height", kDeckRise},
                                    {"floor", rectangle(-half_, low, half_, low + width_)}});
        for (const double side : {-1.0, 1.0})
            layout["links"].push_back(
                {{"id", fmt::format("stairs {}{}", i + 1, side < 0.0 ? "a" : "b")},
                 {"from", "concourse"},
                 {"to", nameOf(i)},
                 {"path", points({{side * (kStairsAt + kStairsRun), y}, {side * kStairsAt, y}})},
                 {"width", values_["stairs"]}});
        if (values_.whole("escalators") == 0) return;
        for (const double side : {-1.0, 1.0}) {
            const std::vector<glm::dvec2> up{{side * (kBeltAt + kBelt), y}, {side * kBeltAt, y}};
            const bool goes_up = side < 0.0;
            layout["links"].push_back({{"id", fmt::format("escalator {} {}", i + 1, goes_up ? "up" : "down")},
                                       {"type", "escalator"},
                                       {"from", goes_up ? "concourse" : nameOf(i)},
                                       {"to", goes_up ? nameOf(i) : "concourse"},
                                       {"path", points(goes_up ? up : std::vector{up[1], up[0]})},
                                       {"stand", "right"}});
        }
    }

    /// Half of them come out of trains, the others go to them.
    void addPeople(Json& layout, std::uint64_t i) const {
        const double low = lowerOf(i), edge = 1.0;
        const std::string train = fmt::format("train {}", i + 1), board = fmt::format("board {}", i + 1);
        layout["areas"].push_back(
            area(train, nameOf(i),
                 rectangle(-half_ + 3.0, low + width_ - 0.2 - edge, half_ - 3.0, low + width_ - 0.2)));
        layout["areas"].push_back(area(board, nameOf(i), rectangle(-8.0, low + 0.3, 8.0, low + 0.3 + edge)));
        const std::uint64_t people = shareOf(values_.whole("people"), i, count_);
        const double end = std::min(values_["time"], values_["duration"]);
        const std::uint64_t off = people - people / 2;
        if (off > 0)
            layout["flows"].push_back(flow("off " + train, train, {{"nearest", {"west", "east"}}}, off, end));
        for (std::uint64_t gate = 0; gate < 2; ++gate)
            if (const std::uint64_t on = shareOf(people / 2, gate, 2))
                layout["flows"].push_back(
                    flow(fmt::format("to {} from {}", train, gate == 0 ? "west" : "east"),
                         gate == 0 ? "west" : "east", board, on, end));
    }

    const GeneratorValues& values_;
    std::uint64_t count_;
    double width_, half_, depth_ = 0.0;
};

constexpr double kFloor = 3.4, kFlight = 6.4, kLanding = 1.8, kDoor = 1.0, kThin = 0.15;  // m

/// Rooms on both sides of a corridor on each floor, and stairs at its ends, one flight from floor to floor,
/// on the one side of the landing and on the other in turn.
class Office {
  public:
    explicit Office(const GeneratorValues& values)
        : values_(values),
          floors_(values.whole("floors")),
          rooms_(values.whole("rooms")),
          corridor_(values["corridor"]),
          stairs_(values["stairs"]),
          room_(values["room"]),
          deep_(std::max(values["room"], values["stairs"] + 0.5)),
          half_(0.5 * static_cast<double>(rooms_) * room_) {}

    Json make() const {
        Json layout = frameOf("office", values_);
        Json exits = Json::array();
        for (std::uint64_t i = 0; i < floors_; ++i)
            addFloor(layout, i);
        for (std::uint64_t i = 0; i + 1 < floors_; ++i)
            for (const double side : {-1.0, 1.0})
                addFlight(layout, i, side);
        for (const auto& [id, side] : {std::pair{"west exit", -1.0}, std::pair{"east exit", 1.0}}) {
            exits.push_back(id);
            const double a = side * (end() + 1.0), b = side * (end() + 3.5), y = 0.5 * corridor_ + stairs_;
            layout["areas"].push_back(area(id, "floor 1", rectangle(std::min(a, b), -y, std::max(a, b), y)));
        }
        for (std::uint64_t i = 0; i < floors_; ++i)
            addRooms(layout, i, exits);
        return layout;
    }

  private:
    static std::string nameOf(std::uint64_t i) { return fmt::format("floor {}", i + 1); }
    /// Where the landings end.
    double end() const { return half_ + 2.0 * kLanding + kFlight; }
    double wide() const { return 0.5 * corridor_ + stairs_ + 0.4; }

    /// Rooms and corridor, and narrower landings at both ends; the lowest one reaches on to the exits.
    void addFloor(Json& layout, std::uint64_t i) const {
        const double y = 0.5 * corridor_ + deep_, x = end() + (i == 0 ? 4.0 : 0.0), w = wide();
        Json floor = points({{-x, -w},
                             {-half_, -w},
                             {-half_, -y},
                             {half_, -y},
                             {half_, -w},
                             {x, -w},
                             {x, w},
                             {half_, w},
                             {half_, y},
                             {-half_, y},
                             {-half_, w},
                             {-x, w}});
        layout["levels"].push_back(
            {{"id", nameOf(i)}, {"height", rounded(kFloor * static_cast<double>(i))}, {"floor", floor}});
    }

    void addFlight(Json& layout, std::uint64_t i, double side) const {
        const bool outwards = i % 2 == 0;
        const double near = side * (half_ + kLanding), far = side * (half_ + kLanding + kFlight);
        const double y = (outwards ? 1.0 : -1.0) * (0.5 * corridor_ + 0.1 + 0.5 * stairs_);
        layout["links"].push_back({{"id", fmt::format("stairs {}{}", i + 1, side < 0.0 ? "a" : "b")},
                                   {"from", nameOf(i)},
                                   {"to", nameOf(i + 1)},
                                   {"path", points({{outwards ? near : far, y}, {outwards ? far : near, y}})},
                                   {"width", stairs_}});
    }

    void addRooms(Json& layout, std::uint64_t i, const Json& exits) const {
        const std::uint64_t people = values_.whole("people");
        const auto most = static_cast<std::uint64_t>((room_ - 1.0) * (deep_ - 1.0));
        for (std::uint64_t number = 0; number < 2 * rooms_; ++number) {
            const double side = number % 2 == 0 ? 1.0 : -1.0;
            const std::uint64_t along = number / 2;  // on each side
            const double x = -half_ + static_cast<double>(along) * room_, y = side * 0.5 * corridor_;
            const double back = side * (0.5 * corridor_ + deep_);
            const std::string id = fmt::format("room {}.{}", i + 1, number + 1);
            addWalls(layout, nameOf(i), id, x, y, back);
            const double low = std::min(y, back) + 0.5, high = std::max(y, back) - 0.5;
            layout["areas"].push_back(area(id, nameOf(i), rectangle(x + 0.5, low, x + room_ - 0.5, high)));
            const std::uint64_t count = std::min(most, shareOf(people, number, 2 * rooms_));
            if (count > 0)
                layout["flows"].push_back(flow("from " + id, id, nearestOf(exits), count,
                                               std::min(values_["rise"], values_["duration"])));
        }
    }

    /// Towards the corridor, with a door, and to the west; the last one has one to the east, too.
    void addWalls(Json& layout, const std::string& level, const std::string& id, double x, double y,
                  double back) const {
        const double door = x + 0.5 * (room_ - kDoor);
        const auto add = [&](const std::string& name, glm::dvec2 a, glm::dvec2 b) {
            layout["walls"].push_back(
                {{"id", id + name}, {"level", level}, {"thickness", kThin}, {"points", points({a, b})}});
        };
        add(" a", {x, y}, {door, y});
        add(" b", {door + kDoor, y}, {x + room_, y});
        if (x > -half_ + 0.1) add(" c", {x, y}, {x, back});
    }

    const GeneratorValues& values_;
    std::uint64_t floors_, rooms_;
    double corridor_, stairs_, room_, deep_, half_;
};

}  // namespace

Json station(const GeneratorValues& values) {
    return Station(values).make();
}

Json office(const GeneratorValues& values) {
    return Office(values).make();
}

}  // namespace throng::authoring::generate
