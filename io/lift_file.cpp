// SPDX-License-Identifier: Apache-2.0
#include "io/lift_file.h"

#include "io/streams/track_file.h"

namespace throng::io {

using Json = nlohmann::ordered_json;

void writeLifts(const std::filesystem::path& path, std::span<const float> track, std::uint32_t frames,
                std::size_t lifts) {
    writeTrack(path, track, {frames, lifts, kLiftFloats});
}

std::vector<float> readLifts(const Bake& bake) {
    return readTrack(bake.folder / kLiftFile, {bake.frames, bake.lifts.size(), kLiftFloats}, "lifts");
}

std::vector<LiftIdentity> liftsOf(const recording::BakeDescription& description) {
    std::vector<LiftIdentity> lifts;
    for (const authoring::Link& link : description.lifts) {
        const authoring::Lift& lift = link.lift;
        LiftIdentity made{link.id,
                          lift.at - description.output_origin,
                          lift.size,
                          lift.doors,
                          lift.door_width,
                          static_cast<std::uint32_t>(lift.capacity.value_or(0)),
                          {}};
        for (std::size_t stop = 0; stop < lift.levels.size(); ++stop) {
            const authoring::Level& level = description.levels.at(lift.levels[stop]);
            made.stops.push_back({level.id, lift.heights.empty() ? level.height : lift.heights[stop],
                                  lift.doors + (lift.opposite[stop] ? 180.0 : 0.0)});
        }
        lifts.push_back(std::move(made));
    }
    return lifts;
}

Json liftsToJson(const std::vector<LiftIdentity>& lifts) {
    Json list = Json::array();
    for (const LiftIdentity& lift : lifts) {
        Json stops = Json::array();
        for (const LiftIdentity::Stop& stop : lift.stops)
            stops.push_back({{"level", stop.level}, {"height", stop.height}, {"doors", stop.doors}});
        list.push_back({{"id", lift.id},
                        {"at", {lift.at.x, lift.at.y}},
                        {"size", {lift.size.x, lift.size.y}},
                        {"doors", lift.doors},
                        {"door_width", lift.door_width},
                        {"capacity", lift.capacity},
                        {"stops", std::move(stops)}});
    }
    return {{"file", kLiftFile}, {"columns", kLiftColumns}, {"list", std::move(list)}};
}

}  // namespace throng::io
