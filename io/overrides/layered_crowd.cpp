// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/layered_crowd.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/random.h"
#include "recording/heads.h"
#include "recording/spring.h"

namespace throng::io {
namespace {

/// How much of a look there is in a frame: none outside of its frames, all of it within, less near both ends.
double shareOf(const LookTarget& look, double frame) {
    if (!look.frames.holds(frame)) return 0.0;
    if (look.ease <= 0.0) return 1.0;
    const double since = frame - look.frames.first, left = look.frames.last - frame;
    return std::min(look.frames.first == 0 ? 1.0 : recording::easedFrom(since + 1.0, 0.0, look.ease),
                    recording::easedFrom(left + 1.0, 0.0, look.ease));
}

}  // namespace

LayeredCrowd::LayeredCrowd(CrowdReader& crowd)
    : crowd_(crowd), table_(crowd.bake()), sampler_(crowd.streams()) {
    std::map<std::string, std::uint64_t> counts;
    plans_.resize(table_.rows());
    for (std::uint32_t row = 0; row < table_.rows(); ++row) {
        const std::string& group = table_.at(row, "group");
        plans_[row].source = row;
        plans_[row].identity = scramble(wordOf(group)) ^ counts[group]++;
        std::optional<std::uint32_t> first = table_.frame(row, "spawn_frame");
        if (first && *first >= crowd.frames()) first.reset();
        entries_.push_back(first);
    }
}

std::optional<double> LayeredCrowd::entryOf(std::uint32_t row) const {
    const RowPlan& plan = plans_[row];
    if (plan.steps.empty()) {
        const std::optional<std::uint32_t> first = entries_[plan.source];
        return first ? std::optional<double>(*first) : std::nullopt;
    }
    const Step& last = plan.steps.back();
    if (!last.first) return std::nullopt;
    return *last.first + (last.change.retimes() ? last.change.delay : 0.0);
}

double LayeredCrowd::scaleOf(std::uint32_t row) const {
    for (auto step = plans_[row].steps.rbegin(); step != plans_[row].steps.rend(); ++step)
        if (step->change.scale) return *step->change.scale;
    return table_.has("scale") ? table_.number(row, "scale") : 1.0;
}

void LayeredCrowd::add(std::uint32_t row, Step step, std::optional<glm::dvec2> about) {
    RowPlan& plan = plans_[row];
    step.first = entryOf(row);
    if (about) {
        const glm::dvec2 place = *about - bake().origin;
        step.pivot = {static_cast<float>(place.x), static_cast<float>(place.y), 0.0f};
    } else if (step.first) {
        step.pivot = evaluate(row, *step.first, false, nullptr).sample[Stream::pos];
    }
    plan.stands_anew = plan.stands_anew || step.change.moves() || step.change.retimes();
    plan.steps.push_back(std::move(step));
}

void LayeredCrowd::setTrack(std::uint32_t row, std::vector<RowSample> track, double bent) {
    plans_[row].track = std::make_shared<const std::vector<RowSample>>(std::move(track));
    plans_[row].in_track = plans_[row].steps.size();
    plans_[row].bent += bent;
    plans_[row].stands_anew = true;
}

void LayeredCrowd::addWords(std::uint32_t row, const std::vector<std::string>& words) {
    std::vector<std::string>& known = plans_[row].words;
    for (const std::string& word : words)
        if (std::ranges::find(known, word) == known.end()) known.push_back(word);
}

std::uint32_t LayeredCrowd::copy(std::uint32_t row, const std::string& layer, std::uint64_t number) {
    RowPlan plan = plans_[row];
    plan.copy_of = layer;
    plan.identity = scramble(plan.identity ^ wordOf(layer)) ^ number;
    plan.stands_anew = true;
    plans_.push_back(std::move(plan));
    return table_.copyRow(row);
}

RowSample LayeredCrowd::base(const RowPlan& plan, double frame, double pace, bool is_whole,
                             const CrowdFrame* known) const {
    const auto whole = [&](std::uint32_t index) {
        if (plan.track) return (*plan.track)[index];
        if (!known || known->index() != index) return sampler_.whole(plan.source, index);
        RowSample sample;
        for (const StreamInfo& info : kStreams)
            if (crowd_.streams().has(info.id))
                std::ranges::copy(rowOf((*known)[info.id], plan.source), sample[info.id].begin());
        return sample;
    };
    if (is_whole) return whole(static_cast<std::uint32_t>(frame));
    return sampleBetween(whole, frames(), frame, pace);
}

RowMoment LayeredCrowd::evaluate(std::uint32_t row, double frame, bool with_looks,
                                 const CrowdFrame* known) const {
    const RowPlan& plan = plans_[row];
    std::vector<double> times(plan.steps.size());
    double at = frame, pace = 1.0;
    bool is_retimed = false;
    for (std::size_t i = plan.steps.size(); i-- > plan.in_track;) {
        const Step& step = plan.steps[i];
        times[i] = at;
        if (!step.change.retimes() || !step.first) continue;
        at = sourceFrame(at, *step.first, step.change);
        pace *= step.change.speed;
        is_retimed = true;
    }
    const bool is_beyond = at < 0.0 || at > static_cast<double>(frames() - 1);
    const bool is_whole = !is_retimed && !is_beyond && at == std::floor(at);
    RowMoment moment{base(plan, at, pace, is_whole, known), is_beyond};
    for (std::size_t i = plan.in_track; i < plan.steps.size(); ++i) {
        const Step& step = plan.steps[i];
        changeSample(moment.sample, step.pivot, step.change);
        if (step.hidden && step.hidden->holds(std::round(times[i]))) hideSample(moment.sample);
        float& state = moment.sample[Stream::state][0];
        if (step.clip && state > 0.5f && step.clip->frames.holds(std::round(times[i])))
            state += static_cast<float>(step.clip->activity) - std::floor(state);
        if (step.look && with_looks) turnHead(moment.sample, *step.look, times[i], scaleOf(row), known);
    }
    return moment;
}

/// Of bakes without the stream nothing is kept of this.
void LayeredCrowd::turnHead(RowSample& sample, const LookTarget& look, double frame, double scale,
                            const CrowdFrame* known) const {
    const double share = shareOf(look, frame);
    if (share == 0.0 || sample[Stream::state][0] <= 0.5f) return;
    glm::dvec3 target = look.point;
    if (look.row) {
        const RowSample other = evaluate(*look.row, frame, false, known).sample;
        if (other[Stream::state][0] <= 0.5f) return;
        target = {other[Stream::pos][0], other[Stream::pos][1],
                  static_cast<double>(other[Stream::pos][2]) + recording::kEyes * scaleOf(*look.row)};
    }
    const std::array<float, kComponents>& place = sample[Stream::pos];
    const std::array<float, kComponents>& facing = sample[Stream::dir];
    const glm::dvec3 way =
        target - glm::dvec3(place[0], place[1], place[2]) - glm::dvec3(0.0, 0.0, recording::kEyes * scale);
    const double yaw = std::remainder(
        std::atan2(way.y, way.x) - std::atan2(double{facing[1]}, double{facing[0]}), 2.0 * std::numbers::pi);
    const double pitch = std::atan2(way.z, std::hypot(way.x, way.y));
    std::array<float, kComponents>& gaze = sample[Stream::gaze];
    const auto towards = [&](float& value, double wanted, double most) {
        value = static_cast<float>(std::lerp(double{value}, std::clamp(wanted, -most, most), share));
    };
    towards(gaze[0], yaw, recording::kMostYaw);
    towards(gaze[1], pitch, recording::kMostPitch);
    if (share >= 0.5) gaze[2] = look.row ? static_cast<float>(*look.row + 1) : 0.0f;
    // The same from the chest: what is told of the head is a turn of it.
    std::array<float, kComponents>& attention = sample[Stream::attention];
    towards(attention[0], yaw - double{sample[Stream::carriage][1]}, recording::kMostYaw);
    towards(attention[1], pitch, recording::kMostPitch);
    towards(attention[2], 1.0, 1.0);
}

void LayeredCrowd::places(std::uint32_t frame, std::vector<PersonPlace>& result) const {
    result.resize(rows());
    const CrowdFrame whole = crowd_.frame(frame);
    const std::span<const float> pos = whole[Stream::pos];
    for (std::uint32_t row = 0; row < rows(); ++row) {
        if (!plans_[row].isChanged()) {
            const auto place = rowOf(pos, row);
            result[row] = {{place[0], place[1], place[2]}, whole.isThere(row)};
            continue;
        }
        const RowSample sample = evaluate(row, frame, false, &whole).sample;
        const std::array<float, kComponents>& place = sample[Stream::pos];
        result[row] = {{place[0], place[1], place[2]}, sample[Stream::state][0] > 0.5f};
    }
}

}  // namespace throng::io
