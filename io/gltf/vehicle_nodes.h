// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/files/output_file.h"
#include "io/gltf/glb_document.h"
#include "recording/bake_description.h"

namespace throng::io {

/// The vehicles of a bake in a glTF file: simple bodies on wheels that turn.
class VehicleNodes {
  public:
    /// @param track kVehicleFloats of each vehicle, frame by frame, places as the streams have them
    VehicleNodes(const recording::BakeDescription& description, std::span<const float> track,
                 std::uint32_t frames);

    bool empty() const { return description_.vehicles.empty() || frames_ == 0; }
    /// Before the first animated node.
    void addMeshes(GlbDocument& document);
    /// After all that is written before.
    void addNodes(GlbDocument& document, int times);
    /// In the same order.
    void writeTracks(OutputFile& file) const;

  private:
    struct Look {
        std::string kind;
        int body = -1, cabin = -1, axle = -1;
        std::vector<double> axles;  ///< m, from the middle
    };
    const Look& lookOf(const VehicleIdentity& vehicle) const;
    std::span<const float> at(std::uint32_t frame, std::size_t vehicle) const;
    void writeTranslations(OutputFile& file, std::size_t vehicle) const;
    void writeRotations(OutputFile& file, std::size_t vehicle, bool of_wheels) const;
    void writeScales(OutputFile& file, std::size_t vehicle) const;

    const recording::BakeDescription& description_;
    std::span<const float> track_;
    std::uint32_t frames_;
    std::vector<Look> looks_;
};

}  // namespace throng::io
