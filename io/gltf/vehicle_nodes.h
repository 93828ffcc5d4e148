// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/door_track.h"
#include "base/files/output_file.h"
#include "io/gltf/glb_document.h"
#include "recording/bake_description.h"

namespace throng::io {

/// What vehicles of a bake do, frame by frame: kVehicleFloats of each of them, with places as the streams
/// have them, and kDoorFloats, where there are doors.
struct VehicleTracks {
    std::span<const float> places{}, doors{};
};

/// The vehicles of a bake in a glTF file: simple bodies on wheels that turn, with doors that slide.
class VehicleNodes {
  public:
    VehicleNodes(const recording::BakeDescription& description, const VehicleTracks& tracks,
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
    /// Half of a door. Places are a vehicle's own, x ahead and y to its left, m.
    struct Leaf {
        double x, y;    ///< while it is shut: its middle
        double slides;  ///< along x, as far as it goes
        DoorColumn side;
        double width;
    };
    std::vector<Leaf> leavesOf(std::size_t vehicle) const;
    int leafMesh(GlbDocument& document, double width);
    void addDoors(GlbDocument& document, int node, std::size_t vehicle, int times);
    void writeDoors(OutputFile& file, std::size_t vehicle) const;
    const Look& lookOf(const VehicleIdentity& vehicle) const;
    std::span<const float> at(std::uint32_t frame, std::size_t vehicle) const;
    void writeTranslations(OutputFile& file, std::size_t vehicle) const;
    void writeRotations(OutputFile& file, std::size_t vehicle, bool of_wheels) const;
    void writeScales(OutputFile& file, std::size_t vehicle) const;

    const recording::BakeDescription& description_;
    VehicleTracks tracks_;
    std::uint32_t frames_;
    std::vector<Look> looks_;
    std::vector<std::pair<double, int>> leaves_;  ///< meshes, by width
};

}  // namespace throng::io
