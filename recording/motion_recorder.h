// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "recording/attention.h"
#include "recording/bake_description.h"
#include "recording/carriages.h"
#include "recording/footing.h"
#include "recording/footsteps.h"
#include "recording/frame_window.h"
#include "recording/gaits.h"
#include "recording/keep_apart.h"
#include "recording/pose_track.h"

namespace throng::recording {

/// Makes the motion that is shown out of the motion that is simulated: without tremor (FrameWindow), nobody
/// in anybody or in a wall (KeepApart), and with the strides that go with it (GaitTrack).
///
/// Frames come out later than they go in, in the same order. Streams `pos` and `dir` are averages; `state`
/// gets its gaits and phases here: what comes in has the phases at the start. On a terrain, heights and
/// slopes (Footing) follow from these. Streams from the device pass through as they are.
class MotionRecorder {
  public:
    using Sink = std::function<void(const Frame&)>;

    MotionRecorder(const BakeDescription& description, Sink sink);

    void take(const Frame& frame);
    /// Gives out the frames that wait for others, when there are no others.
    void finish();

    /// Frames taken, of an earlier run, too.
    std::uint32_t framesTaken() const { return taken_; }

    std::vector<std::byte> save() const;
    /// @throws std::runtime_error where the bytes are not of this bake
    void restore(std::span<const std::byte> bytes);

  private:
    struct Walker {
        GaitTrack gait;
        glm::vec2 place{0.0f};
        std::uint32_t walks = 0;  ///< 1: there in the frame before
    };
    void giveOut();
    void goHome(const Frame& frame);
    glm::dvec2 toPlane(std::size_t row) const;
    double heightOf(std::size_t row) const;
    float overFoot(std::size_t row, glm::vec2 place) const;
    float liftedBy(std::size_t row) const;
    /// How far the ground has carried somebody since the frame before, m.
    glm::dvec2 carriedBy(std::size_t row) const;
    void average(const KeptFrame& frame);
    void takeOutOfPlane();
    double phaseAtFirst(std::size_t row) const;
    void pose(std::size_t row);
    void takeCue(std::size_t row, double time, PoseWish& wish) const;
    void record(const KeptFrame& frame);
    void putStance(std::size_t at, const Stance& stance);
    static float sizeOf(const KeptFrame& frame, std::size_t row);
    glm::dvec2 axisOf(const KeptFrame& frame, std::size_t row) const;
    void turnChests(const KeptFrame& frame);
    void findOnlookers(const KeptFrame& frame);
    void carry();
    void look(std::uint32_t frame);
    template <class ValuesOf>
    void putAll(std::vector<float>& stream, ValuesOf&& of);
    void putFeet(std::size_t at, const std::array<FootMove, 2>& feet);

    double fps_;
    bool wide_;  ///< places are too coarse for speeds: these follow from the velocities
    std::vector<float> radii_, speeds_, scales_;  ///< by row: m; preferred, m/s; of figures
    Sink sink_;
    FrameWindow window_;
    KeepApart apart_;
    std::vector<Walker> walkers_;
    std::optional<Footing> footing_;                    // none on flat ground
    std::shared_ptr<const authoring::Terrain> ground_;  // likewise
    std::optional<Footsteps> footsteps_;                // none unless asked for
    std::optional<Carriages> carriages_;                // likewise, with them
    std::optional<AttentionTrack> attention_;           // likewise
    StreamChoice carried_;                              // from the device, past all this
    std::uint32_t taken_ = 0;

    std::vector<float> positions_, directions_, states_, grounds_;  ///< of the frame being given out
    std::array<std::vector<float>, 2> feet_;                        ///< likewise: left, right
    std::vector<glm::dvec2> shifts_;  ///< by chart, m: place in the plane - home; none without charts
    std::vector<glm::dvec2> belts_;   ///< by chart, m in a frame: how far its ground moves; none: none does
    std::vector<std::uint32_t> charts_;
    std::vector<BakeCharts::Cabin> cabins_;  ///< by chart; none: there are no lifts
    std::size_t lift_count_ = 0;
    std::vector<float> homes_;  ///< places of the frame being taken, in home coordinates, and charts
    std::vector<std::uint32_t> present_;
    std::vector<float> gaze_values_, attention_values_, carriage_values_, chests_;
    std::vector<float> half_axes_;  ///< by row, m: as gpu::Person has it
    std::vector<MovedBody> bodies_;
    std::vector<Onlooker> onlookers_;
    std::vector<std::uint32_t> parties_;  ///< by row
    std::vector<bool> given_;             ///< by row: its places are given, and shown as they are
    // Where people sit, or do things with their hands; otherwise empty.
    std::vector<PoseTrack> poses_;            ///< by row
    std::vector<double> paces_;               ///< by row, 0 to 1
    std::vector<std::vector<SeatCue>> cues_;  ///< by row; empty: there are no shows
    std::vector<bool> led_;                   ///< by row, in the frame being given out: out of others' way
    std::vector<float> leading_;              ///< of who is led, how much of the way to the first row is left
    std::vector<glm::dvec3>
        aisle_feet_;  ///< on a terrain of one storey, in the frame of reference of the frames
};

}  // namespace throng::recording
