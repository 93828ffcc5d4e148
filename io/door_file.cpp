// SPDX-License-Identifier: Apache-2.0
#include "io/door_file.h"

#include "io/streams/track_file.h"

namespace throng::io {

using Json = nlohmann::ordered_json;

void writeDoors(const std::filesystem::path& path, std::span<const float> track, std::uint32_t frames,
                std::size_t vehicles) {
    writeTrack(path, track, {frames, vehicles, kDoorFloats});
}

std::vector<float> readDoors(const Bake& bake) {
    return readTrack(bake.folder / kDoorFile, {bake.frames, bake.doors.size(), kDoorFloats}, "vehicles");
}

Json doorsToJson(const std::vector<DoorIdentity>& doors) {
    Json list = Json::array();
    for (const DoorIdentity& vehicle : doors)
        list.push_back({{"at", vehicle.at},
                        {"width", vehicle.width},
                        {"left", vehicle.left},
                        {"right", vehicle.right},
                        {"capacity", vehicle.capacity}});
    return {{"file", kDoorFile}, {"columns", kDoorColumns}, {"list", std::move(list)}};
}

}  // namespace throng::io
