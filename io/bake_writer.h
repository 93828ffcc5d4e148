// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/frame.h"
#include "io/bake_folder.h"
#include "io/checkpoint.h"
#include "io/manifest.h"
#include "io/streams/entered_hash.h"
#include "io/streams/stream_files.h"
#include "io/streams/track_file.h"
#include "recording/bake_description.h"

namespace throng::io {

/// What finish() made.
struct BakeResult {
    std::filesystem::path path;
    std::uint32_t frames = 0;
    AccountTotals account;
    std::optional<GltfSummary> gltf;  ///< people are left out where agents < of
    std::uint32_t diagrams = 0;       ///< images
};

/// Turns a stream of frames into a bake folder (docs/bake.md), which appears under its name only when it is
/// complete. Not thread-safe, but any one thread may own it. Members throw OutputError when anything cannot
/// be written; after that, or without finish(), the destructor removes all that was written.
class BakeWriter {
  public:
    /// An error before any work when the bake exists (see BakeFolder).
    explicit BakeWriter(const recording::BakeDescription& description);
    /// The same for a bake that leaves checkpoints in `NAME.unfinished`.
    /// @param go_on_from where it goes on, or null where it begins
    BakeWriter(const recording::BakeDescription& description, const Checkpoint* go_on_from);

    /// Takes the frames in order, index 0 first. The spans need to live during the call only. Throws
    /// std::invalid_argument when the frame does not fit the description, or lacks one of its streams.
    void write(const Frame& frame);
    /// Writes the frame's diagram when it has one and its index is a multiple of `diagram_every`: in order,
    /// too, but as long before write() as one likes.
    void writeDiagram(const Frame& frame);
    /// Lets those who look on see vehicles, as far as their track is known: from the first frame on.
    void showVehicles(std::span<const float> track);
    /// Where the vehicles of all frames were, as Frame::vehicles, before it is finished.
    void takeVehicles(std::vector<float> track) { vehicle_track_ = std::move(track); }
    /// Likewise the lifts, as Frame::lifts.
    void takeLifts(std::vector<float> track) { lift_track_ = std::move(track); }
    /// Likewise the doors of vehicles, as Frame::doors.
    void takeDoors(std::vector<float> track) { door_track_ = std::move(track); }

    /// Completes the bake; std::logic_error unless all expected frames were written, or it may end before.
    BakeResult finish(const Account& account, const BakeTiming& timing);
    /// Completes what there is as `NAME.partial`, with "complete": false: for bakes that were interrupted.
    BakeResult finishPartial(const Account& account, const BakeTiming& timing);

    /// Puts what has been written on the disk, and with it all that a later run needs to go on from here.
    /// @param checkpoint with the simulation's part in it
    void save(Checkpoint checkpoint);
    /// Leaves what there is for a later run, which goes on from the last checkpoint.
    void leave() { folder_->keep(); }

    /// Ends what finish() was killed in: removes the checkpoints of a bake that has its name already.
    static void tidy(const std::filesystem::path& bake);

    std::uint32_t framesWritten() const { return frames_; }

  private:
    BakeWriter(recording::BakeDescription description, std::unique_ptr<BakeFolder> folder,
               const Checkpoint* go_on_from);
    void openStreams(const Checkpoint* go_on_from);
    void goOnFrom(const Checkpoint& checkpoint);
    void hashAgain(std::size_t stream, std::uint64_t then);
    void goOnWithDiagrams(const Checkpoint& checkpoint);
    /// Of a frame that has any: the second of them where people walk above people.
    std::vector<std::string> diagramNames(std::uint32_t frame) const;
    void addHashes(Checkpoint& checkpoint) const;
    void removeLeftovers(const Checkpoint& checkpoint) const;
    void trackPeople(const Frame& frame);
    std::span<const float> placed(std::span<const float> places);
    BakeOutcome writeAll(const Account& account, const BakeTiming& timing, bool complete);
    BakeResult resultAt(std::filesystem::path path, const BakeOutcome& outcome) const;

    recording::BakeDescription description_;
    std::unique_ptr<BakeFolder> folder_;
    std::vector<StreamFiles> streams_;
    std::vector<EnteredHash> hashes_;  ///< of each of them, so far
    std::uint32_t frames_ = 0;
    std::vector<std::uint32_t> first_alive_;  ///< per row, the first frame it is alive in, or kNone
    std::uint32_t gaits_ = 0;                 ///< BakeOutcome::gaits, so far
    std::vector<float> placed_;               ///< one frame of places in the output frame of reference
    std::optional<DiagramSummary> diagrams_;
    std::vector<BakeOutcome::File> diagram_files_;
    std::optional<TrackWriter> shown_vehicles_;
    std::vector<float> vehicle_track_, lift_track_, door_track_;
};

}  // namespace throng::io
