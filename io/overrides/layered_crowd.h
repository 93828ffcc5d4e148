// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "authoring/overrides/layers.h"
#include "io/crowd_reader.h"
#include "io/overrides/agent_table_edit.h"
#include "io/overrides/row_sampler.h"

namespace throng::io {

/// What heads turn to, in the frame of the streams.
struct LookTarget {
    std::optional<std::uint32_t> row;
    glm::dvec3 point{0.0};  ///< m, where it is nobody
    authoring::FrameRange frames;
    double ease = 0.0;  ///< frames
};

/// One thing that is done to somebody.
struct Step {
    authoring::PersonChange change;
    std::optional<authoring::FrameRange> hidden = {};
    std::optional<authoring::Clip> clip = {};
    std::optional<LookTarget> look = {};
    bool is_of_layer = false;
    std::optional<double> first = {};        ///< frame of the entry before this step
    std::array<float, kComponents> pivot{};  ///< m: what it turns about
};

/// What becomes of a row: the steps, one after the other.
struct RowPlan {
    std::uint32_t source = 0;                               ///< row of the bake
    std::shared_ptr<const std::vector<RowSample>> track{};  ///< frame by frame, instead of the bake's
    std::size_t in_track = 0;                               ///< the first steps, which the track has in it
    std::vector<Step> steps{};
    std::uint64_t identity = 0;  ///< what draws are made of: the how-manieth of its group, and which copy
    std::string copy_of{};       ///< the layer that made it
    std::vector<std::string> words{};  ///< what is done to it
    double bent = 0.0;                 ///< m, by which its way is bent at most
    bool stands_anew = false;          ///< it is not where it was, or not when

    bool isChanged() const { return track || !steps.empty() || !copy_of.empty(); }
};

/// A row at a time.
struct RowMoment {
    RowSample sample;
    bool is_beyond = false;  ///< the bake has no frames for it
};

struct PersonPlace {
    glm::dvec3 place{0.0};  ///< m, in the frame of the streams
    bool is_there = false;
};

/// A bake and what has been done to its people so far. Copies are rows after the bake's own.
class LayeredCrowd {
  public:
    explicit LayeredCrowd(CrowdReader& crowd);
    LayeredCrowd(const LayeredCrowd&) = delete;
    LayeredCrowd& operator=(const LayeredCrowd&) = delete;

    const Bake& bake() const { return crowd_.bake(); }
    CrowdReader& source() const { return crowd_; }
    AgentTableEdit& table() { return table_; }
    const AgentTableEdit& table() const { return table_; }
    std::uint32_t rows() const { return static_cast<std::uint32_t>(plans_.size()); }
    std::uint32_t frames() const { return crowd_.frames(); }
    const RowPlan& plan(std::uint32_t row) const { return plans_[row]; }
    const AgentRow& person(std::uint32_t row) const { return crowd_.people()[plans_[row].source]; }
    double scaleOf(std::uint32_t row) const;
    /// The frame of its entry, as it is so far; nothing for who never comes.
    std::optional<double> entryOf(std::uint32_t row) const;

    /// @param about m, world: what is turned about; without, the place of the entry
    void add(std::uint32_t row, Step step, std::optional<glm::dvec2> about = {});
    /// @param bent m, by which the way is bent at most
    void setTrack(std::uint32_t row, std::vector<RowSample> track, double bent);
    void addWords(std::uint32_t row, const std::vector<std::string>& words);
    /// Another one like this, as it is so far. @returns its row
    std::uint32_t copy(std::uint32_t row, const std::string& layer, std::uint64_t number);

    /// Somebody at any time. Reads single rows.
    RowMoment at(std::uint32_t row, double frame) const { return evaluate(row, frame, true, nullptr); }
    /// The same in a frame of the source that has been read.
    RowMoment at(std::uint32_t row, const CrowdFrame& frame) const {
        return evaluate(row, frame.index(), true, &frame);
    }
    /// Everybody's place in one frame.
    void places(std::uint32_t frame, std::vector<PersonPlace>& result) const;

  private:
    RowMoment evaluate(std::uint32_t row, double frame, bool with_looks, const CrowdFrame* known) const;
    RowSample base(const RowPlan& plan, double frame, double pace, bool is_whole,
                   const CrowdFrame* known) const;
    void turnHead(RowSample& sample, const LookTarget& look, double frame, double scale,
                  const CrowdFrame* known) const;

    CrowdReader& crowd_;
    AgentTableEdit table_;
    RowSampler sampler_;
    std::vector<RowPlan> plans_;
    std::vector<std::optional<std::uint32_t>> entries_;  ///< of the bake's rows
};

}  // namespace throng::io
