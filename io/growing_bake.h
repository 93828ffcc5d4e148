// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "io/crowd_reader.h"
#include "io/streams/growing_stream.h"
#include "io/streams/track_file.h"
#include "io/under_way.h"

namespace throng::io {

/// A bake as far as it has come: one that is under way, was stopped, or is complete. Reads only.
class GrowingBake {
  public:
    /// @param path the folder that the bake has or will have, or the one that it is written in
    /// @throws InputError where there is none
    explicit GrowingBake(const std::filesystem::path& path);

    const Bake& bake() const { return expected_.bake; }
    const std::vector<AgentRow>& people() const { return expected_.people; }
    /// Where it lay when it was opened.
    const std::filesystem::path& folder() const { return folder_; }
    /// Whether it was one under way then.
    bool isUnderWay() const { return !complete_; }

    /// Frames that can be read now.
    std::uint32_t frames();
    /// Where everybody is, and what everybody does: as the streams `pos` and `state` have it.
    void readFrame(std::uint32_t frame, std::vector<float>& places, std::vector<float>& states);

    /// Where its vehicles are: kVehicleFloats of each; none where it has none.
    void readVehicles(std::uint32_t frame, std::vector<float>& vehicles);

    /// Whether what was opened is not what there is any more: it has been completed, given up or begun anew.
    bool isOver() const;

  private:
    void remember(const char* file);

    std::filesystem::path path_, folder_;
    ExpectedBake expected_;
    std::unique_ptr<CrowdReader> complete_;
    std::optional<GrowingStream> places_, states_;
    std::optional<GrowingTrack> vehicles_;
    std::filesystem::path told_by_;  ///< the file that says what it is, as it was when it was opened
    std::filesystem::file_time_type told_at_{};
};

}  // namespace throng::io
