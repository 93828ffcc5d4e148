// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/apply_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "base/files/errors.h"
#include "base/random.h"
#include "io/overrides/bend_track.h"
#include "io/overrides/selection.h"

namespace throng::io {
namespace {

using authoring::Duplicate;
using authoring::Operations;
using authoring::PersonChange;

constexpr double kMostBent = 2097152.0;  // frames of people, of 132 bytes each

/// One layer on its way.
class LayerWork {
  public:
    LayerWork(LayeredCrowd& crowd, const authoring::Layer& layer,
              std::span<const authoring::Entrant> entrants, std::uint32_t most_people)
        : crowd_(crowd), layer_(layer), selection_(crowd, entrants), most_people_(most_people) {}

    LayerResult apply() {
        const std::vector<bool> chosen = selection_.whom(layer_.who);
        for (std::uint32_t row = 0; row < crowd_.rows(); ++row)
            if (chosen[row]) result_.rows.push_back(row);
        result_.remarks = selection_.remarks();
        if (result_.rows.empty()) result_.remarks.emplace_back("means nobody");
        const Operations& operations = layer_.operations;
        retime(operations.change);
        if (operations.bend) bend(*operations.bend);
        changeTheRest(operations);
        for (const std::uint32_t row : result_.rows)
            crowd_.addWords(row, authoring::operationWords(operations));
        if (operations.duplicate) duplicate(*operations.duplicate);
        return std::move(result_);
    }

  private:
    void retime(const PersonChange& change) {
        if (!change.retimes()) return;
        Step step;
        step.is_of_layer = true;
        step.change.delay = change.delay;
        step.change.speed = change.speed;
        for (const std::uint32_t row : result_.rows)
            crowd_.add(row, step);
    }

    void bend(const authoring::Bend& bend) {
        if (static_cast<double>(result_.rows.size()) * crowd_.frames() > kMostBent)
            throw InputError(
                crowd_.bake().folder,
                fmt::format("the layer `{}` bends the ways of {} people over {} frames: at most {:.0f} "
                            "frames of people can be bent in a layer",
                            layer_.name, result_.rows.size(), crowd_.frames(), kMostBent));
        std::size_t unbent = 0;
        double furthest = 0.0;
        for (const authoring::BendPoint& point : bend.points)
            furthest = std::max(furthest, glm::length(point.by));
        for (const std::uint32_t row : result_.rows) {
            BentTrack track = bendTrack(crowd_, row, bend);
            unbent += track.samples.empty();
            if (track.samples.empty()) continue;
            if (track.acceleration > bend.most_acceleration * (1.0 + 1.0e-6))
                result_.sharp.push_back({row, track.acceleration, track.frame});
            crowd_.setTrack(row, std::move(track.samples), furthest);
        }
        if (unbent)
            result_.remarks.push_back(
                fmt::format("{} of them are not there when their ways would be bent", unbent));
        std::ranges::stable_sort(result_.sharp, std::ranges::greater(), &SharpBend::acceleration);
        if (!result_.sharp.empty())
            result_.remarks.push_back(
                fmt::format("the bend adds more than {} m/s^2 to {} of them, most of all to {}: {:.2f} in "
                            "frame {}; give it more "
                            "time or way",
                            bend.most_acceleration, result_.sharp.size(), result_.sharp.front().row,
                            result_.sharp.front().acceleration, result_.sharp.front().frame));
    }

    void changeTheRest(const Operations& operations) {
        Step step;
        step.is_of_layer = true;
        step.change = operations.change;
        step.change.delay = 0.0;
        step.change.speed = 1.0;
        step.hidden = operations.hidden;
        step.clip = operations.clip;
        if (operations.look_at) step.look = targetOf(*operations.look_at);
        if (step.change.changesNothing() && !step.hidden && !step.clip && !step.look) return;
        std::uint32_t number = 0;
        for (const std::uint32_t row : result_.rows) {
            Step own = step;
            if (!step.change.hero.empty() && result_.rows.size() > 1)
                own.change.hero = fmt::format("{} {}", step.change.hero, ++number);
            if (own.look && own.look->row == row) own.look.reset();  // nobody looks at oneself
            crowd_.add(row, std::move(own), operations.about);
        }
    }

    std::optional<LookTarget> targetOf(const authoring::LookAt& look) {
        const auto& streams = crowd_.source().streams();
        if (!streams.has(Stream::gaze) && !streams.has(Stream::attention)) {
            result_.remarks.emplace_back(
                "nobody's head turns: the bake has no stream `gaze`, and no "
                "`attention` (throng bake --attention)");
            return std::nullopt;
        }
        LookTarget target;
        target.frames = look.frames;
        target.ease = look.ease;
        if (look.person) {
            target.row = selection_.rowOf(*look.person);
            if (target.row) return target;
            result_.remarks.push_back(fmt::format(
                "nobody's head turns: person {} of `{}`, who is looked at, is nobody in this bake",
                look.person->id, look.person->group));
            return std::nullopt;
        }
        const Bake& bake = crowd_.bake();
        target.point =
            *look.point - glm::dvec3(bake.origin, bake.manifest.value("/origin/2"_json_pointer, 0.0));
        return target;
    }

    void duplicate(const Duplicate& duplicate) {
        const double total =
            crowd_.rows() + static_cast<double>(duplicate.copies) * static_cast<double>(result_.rows.size());
        if (total > most_people_)
            throw InputError(
                crowd_.bake().folder,
                fmt::format("the layer `{}` would make {:.0f} people of it: at most {} are possible",
                            layer_.name, total, most_people_));
        for (std::uint64_t number = 1; number <= duplicate.copies; ++number) {
            std::map<std::uint32_t, std::uint32_t> made;  // copies by whom they are of
            for (const std::uint32_t row : result_.rows)
                made[row] = makeCopy(row, duplicate, number);
            result_.copies += static_cast<std::uint32_t>(made.size());
            walkTogether(made);
        }
    }

    std::uint32_t makeCopy(std::uint32_t row, const Duplicate& duplicate, std::uint64_t number) {
        const std::uint32_t copy = crowd_.copy(row, layer_.name, number);
        const auto times = static_cast<double>(number);
        Step step;
        step.is_of_layer = true;
        step.change = duplicate.each;
        step.change.move *= times;
        step.change.turn = std::remainder(step.change.turn * times, 360.0);
        step.change.delay *= times;
        if (duplicate.scatter > 0.0) {
            const std::uint64_t word = scramble(crowd_.plan(copy).identity ^ scramble(duplicate.seed + 1));
            const double angle = 2.0 * std::numbers::pi * fractionOf(word);
            const double share = fractionOf(scramble(word));
            const double far = duplicate.scatter * std::sqrt(share);  // even over the disc
            step.change.move += far * glm::dvec3(std::cos(angle), std::sin(angle), 0.0);
        }
        if (!step.change.changesNothing()) crowd_.add(copy, std::move(step), duplicate.about);
        return copy;
    }

    /// Copies of those who walk together walk together.
    void walkTogether(const std::map<std::uint32_t, std::uint32_t>& made) {
        AgentTableEdit& table = crowd_.table();
        if (!table.has("party")) return;
        std::map<std::uint32_t, std::uint32_t> first;  // copy, by the party of whom it is of
        for (const auto& [row, copy] : made) {
            const std::uint32_t party = table.frame(row, "party").value_or(row);
            table.set(copy, "party", std::to_string(first.emplace(party, copy).first->second));
        }
    }

    LayeredCrowd& crowd_;
    const authoring::Layer& layer_;
    Selection selection_;
    std::uint32_t most_people_;
    LayerResult result_;
};

}  // namespace

std::vector<LayerResult> applyLayers(LayeredCrowd& crowd, std::span<const authoring::Layer> layers,
                                     std::span<const authoring::Entrant> entrants,
                                     std::uint32_t most_people) {
    std::vector<LayerResult> results;
    for (const authoring::Layer& layer : layers)
        results.push_back(layer.enabled ? LayerWork(crowd, layer, entrants, most_people).apply()
                                        : LayerResult{});
    return results;
}

}  // namespace throng::io
