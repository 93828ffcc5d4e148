// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "authoring/family/generate.h"
#include "authoring/layout/seat_mouths.h"
#include "authoring/layout/seat_rows.h"

namespace throng::authoring::generate {
namespace {

constexpr double kPitch = 0.85, kRise = 0.38, kHeight = 1.0;  // m
constexpr double kBeforeRows = 1.0;                           // m, between the pitch and the first row
constexpr double kBetweenStands = 1.5;                        // m, half of the gap at the first row
constexpr double kAisleEach = 9.0;                            // m of the first row
constexpr double kGate = 3.0;                                 // m, depth of an exit
// Each exit and each aisle has a field of its own, and the ground is coarser the more there are.
constexpr double kMostRadius = 45.0;  // m
constexpr std::uint64_t kMostRows = 16, kMostGoals = 36, kMostPeople = 40000, kRowsForOpenings = 6;

double degrees(double radians) {
    return radians * 180.0 / std::numbers::pi;
}

/// A part of a ring, in pieces of a tenth of a radian.
std::vector<glm::dvec2> roundSector(double inner, double outer, double from, double to) {
    constexpr double kPiece = 0.1;  // rad
    const int pieces = std::max(2, static_cast<int>(std::ceil((to - from) / kPiece)));
    return sector(inner, outer, from, to - from, pieces);
}

/// Blocks of seats round a pitch, each with a part of the concourse behind it.
class Stands {
  public:
    explicit Stands(const GeneratorValues& values)
        : count_(std::max<std::uint64_t>(values.whole("stands"), 2)),
          front_(std::min(values["radius"], kMostRadius) + kBeforeRows),
          step_(2.0 * std::numbers::pi / static_cast<double>(count_)) {
        const double depth = std::max(values["stand"] - kBeforeRows, 2.0 * kPitch);
        rows_ = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(depth / kPitch), 2, kMostRows);
        back_ = front_ + (static_cast<double>(rows_) - 0.5) * kPitch;
        const double gap = std::min(kBetweenStands / front_, 0.2 * step_);
        block_.rows = rows_;
        block_.pitch = kPitch;
        block_.rise = kRise;
        block_.height = kHeight;
        block_.front = arcFront({0.0, 0.0}, front_, degrees(gap), degrees(step_ - gap));
        block_.aisles = std::clamp<std::uint64_t>(
            static_cast<std::uint64_t>(std::lround(front_ * (step_ - 2.0 * gap) / kAisleEach)), 1,
            std::max<std::uint64_t>(1, (kMostGoals - values.whole("exits")) / count_));
        gap_ = gap;
        chooseMouths();
        const double outside = onPassage() ? back_ + *block_.mouths.passage : back_;
        // The floor's railing is below the passages.
        const double opening = front_ + (static_cast<double>(landingRow(block_)) + 0.5) * kPitch;
        inner_ = opening + 0.3;
        outer_ = outside + std::max(8.0, 0.06 * front_) + kGate;
    }

    Json make(const GeneratorValues& values) const {
        Json layout = frameOf("stadium", values);
        layout["levels"].push_back({{"id", "pitch"}, {"floor", points(round(front_ - kBeforeRows))}});
        for (std::uint64_t i = 0; i < count_; ++i)
            layout["levels"].push_back(
                {{"id", concourse(i)},
                 {"floor", points(roundSector(inner_, outer_, angleOf(i), angleOf(i + 1)))}});
        const Json gates = addGates(layout, values);
        const auto seats = static_cast<double>(countSeats(block_) * count_);
        const double people = static_cast<double>(std::min(values.whole("people"), kMostPeople));
        for (std::uint64_t i = 0; i < count_; ++i)
            layout["seats"].push_back(blockOf(i, std::min(1.0, people / seats), gates, values));
        return layout;
    }

  private:
    bool onPassage() const { return block_.mouths.at == SeatBlock::Mouths::At::back; }
    double angleOf(std::uint64_t i) const { return step_ * static_cast<double>(i); }
    static std::string concourse(std::uint64_t i) { return fmt::format("concourse {}", i + 1); }

    /// Low stands are left behind their last row, by steps that are as long as they have to be.
    void chooseMouths() {
        constexpr double kSteepest = 0.7;
        block_.mouths.at =
            rows_ < kRowsForOpenings ? SeatBlock::Mouths::At::back : SeatBlock::Mouths::At::row;
        block_.mouths.row = std::max<std::uint64_t>(2, rows_ / 3);
        const double high = kHeight + kRise * static_cast<double>(landingRow(block_));
        if (onPassage()) block_.mouths.passage = rounded(high / kSteepest + 0.1);
    }

    static std::vector<glm::dvec2> round(double radius) {
        std::vector<glm::dvec2> outline;
        constexpr int kSides = 48;
        for (int i = 0; i < kSides; ++i)
            outline.push_back(onCircle(radius, 2.0 * std::numbers::pi * i / kSides));
        return outline;
    }

    /// Evenly round the concourse, each within one part of it.
    Json addGates(Json& layout, const GeneratorValues& values) const {
        const std::uint64_t exits = values.whole("exits");
        Json gates = Json::array();
        for (std::uint64_t i = 0; i < exits; ++i) {
            const std::uint64_t part = i * count_ / exits;
            const std::uint64_t first = (part * exits + count_ - 1) / count_;
            const std::uint64_t end = ((part + 1) * exits + count_ - 1) / count_;
            const double each = step_ / static_cast<double>(end - first);
            const double middle = angleOf(part) + each * (static_cast<double>(i - first) + 0.5);
            const double outside = outer_ * std::cos(0.05) - 0.5;  // within the floor's chords
            const double half = std::min(0.5 * values["exit_width"] / outside, 0.4 * each);
            gates.push_back(fmt::format("exit {}", i + 1));
            layout["areas"].push_back(
                {{"id", gates.back()},
                 {"level", concourse(part)},
                 {"polygon", points(roundSector(outside - kGate, outside, middle - half, middle + half))}});
        }
        return gates;
    }

    Json blockOf(std::uint64_t i, double occupancy, const Json& gates, const GeneratorValues& values) const {
        Json mouths = {{"at", onPassage() ? "back" : "row"}};
        if (onPassage())
            mouths["passage"] = *block_.mouths.passage;
        else
            mouths["row"] = block_.mouths.row;
        mouths["level"] = concourse(i);
        const double end = std::max(std::min(values["rise"], values["duration"]), 0.05);
        return {{"id", fmt::format("stand {}", i + 1)},
                {"arc",
                 {{"centre", {0, 0}},
                  {"radius", rounded(front_)},
                  {"from", rounded(degrees(angleOf(i) + gap_))},
                  {"to", rounded(degrees(angleOf(i + 1) - gap_))}}},
                {"rows", rows_},
                {"pitch", kPitch},
                {"rise", kRise},
                {"height", kHeight},
                {"aisles", block_.aisles},
                {"level", "pitch"},
                {"mouths", mouths},
                {"occupancy", std::max(rounded(occupancy), 0.001)},
                {"leave", {{"at", {{"uniform", {0, rounded(end)}}}}, {"to", nearestOf(gates)}}}};
    }

    std::uint64_t count_, rows_ = 2;
    double front_, back_ = 0.0, step_, gap_ = 0.0, inner_ = 0.0, outer_ = 0.0;
    SeatBlock block_;
};

}  // namespace

Json stadiumOfStands(const GeneratorValues& values) {
    return Stands(values).make(values);
}

}  // namespace throng::authoring::generate
