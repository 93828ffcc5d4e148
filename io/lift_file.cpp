// SPDX-License-Identifier: Apache-2.0
#include "io/lift_file.h"

#include "io/streams/track_file.h"

namespace throng::io {

using Json = nlohmann::ordered_json;

void writeLifts(const std::filesystem::path& path, std::span<const float> track, std::uint32_t frames,
                std::size_t lifts) {
    writeTrack(path, track, {frames, lifts, kLiftFloats});
}

Json liftsToJson(const recording::BakeDescription& description) {
    Json list = Json::array();
    for (const authoring::Link& link : description.lifts) {
        const authoring::Lift& lift = link.lift;
        Json stops = Json::array();
        for (std::size_t stop = 0; stop < lift.levels.size(); ++stop)
            stops.push_back({{"level", description.levels.at(lift.levels[stop]).id},
                             {"height", description.levels.at(lift.levels[stop]).height},
                             {"doors", lift.doors + (lift.opposite[stop] ? 180.0 : 0.0)}});
        const glm::dvec2 at = lift.at - description.output_origin;
        list.push_back({{"id", link.id},
                        {"at", {at.x, at.y}},
                        {"size", {lift.size.x, lift.size.y}},
                        {"doors", lift.doors},
                        {"door_width", lift.door_width},
                        {"capacity", lift.capacity.value_or(0)},
                        {"stops", std::move(stops)}});
    }
    return {{"file", kLiftFile}, {"columns", kLiftColumns}, {"list", std::move(list)}};
}

}  // namespace throng::io
