// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/files/output_file.h"
#include "base/lift_track.h"
#include "io/gltf/glb_document.h"

namespace throng::io {

/// What lifts of a bake do, frame by frame: kLiftFloats of each of them.
struct LiftTracks {
    std::vector<LiftIdentity> lifts = {};
    std::span<const float> track{};
};

/// The lifts of a bake in a glTF file: cabins that go up and down, and at each of their stops two leaves that
/// slide.
class LiftNodes {
  public:
    LiftNodes(const LiftTracks& tracks, std::uint32_t frames) : tracks_(tracks), frames_(frames) {}

    bool empty() const { return tracks_.lifts.empty() || frames_ == 0; }
    /// Before the first animated node.
    void addMeshes(GlbDocument& document);
    /// After all that is written before.
    void addNodes(GlbDocument& document, int times);
    /// In the same order.
    void writeTracks(OutputFile& file) const;

  private:
    /// Half of the doors of a stop. Places are those of the bake, m.
    struct Leaf {
        std::size_t lift = 0, stop = 0;
        glm::dvec2 place{0.0};   ///< while it is shut: its middle
        glm::dvec2 slides{0.0};  ///< as far as it goes
        int mesh = -1;
    };
    float of(std::uint32_t frame, std::size_t lift, LiftColumn column) const;
    double openAt(std::uint32_t frame, const Leaf& leaf) const;

    const LiftTracks& tracks_;
    std::uint32_t frames_;
    std::vector<int> cabins_;  ///< meshes, by lift
    std::vector<Leaf> leaves_;
};

}  // namespace throng::io
