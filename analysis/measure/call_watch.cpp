// SPDX-License-Identifier: Apache-2.0
#include "analysis/measure/call_watch.h"

#include <algorithm>

#include "base/door_track.h"
#include "io/door_file.h"
#include "io/vehicle_file.h"

namespace throng::analysis {

std::vector<VehicleCall> callsIn(const io::Bake& bake) {
    std::vector<VehicleCall> calls;
    if (bake.doors.empty()) return calls;
    const std::vector<float> places = io::readVehicles(bake), doors = io::readDoors(bake);
    const std::size_t vehicles = bake.vehicles.size();
    const auto count = [&](std::size_t row, DoorColumn column) {
        return static_cast<std::uint32_t>(doorIn(doors, row, column));
    };
    for (std::size_t vehicle = 0; vehicle < vehicles; ++vehicle) {
        bool stood = false, opened = false;
        for (std::uint32_t frame = 0; frame < bake.frames; ++frame) {
            const std::size_t row = frame * vehicles + vehicle;
            const bool stands =
                places[row * kVehicleFloats + static_cast<std::size_t>(VehicleColumn::state)] ==
                kVehicleStands;
            if (stands && !stood) {
                calls.push_back({bake.vehicles[vehicle].flow, vehicle, frame / bake.fps});
                opened = false;
            }
            if (stands) {
                opened = opened ||
                         doorIn(doors, row, DoorColumn::left) + doorIn(doors, row, DoorColumn::right) > 0.0f;
                calls.back().dwell = (frame + 1) / bake.fps - calls.back().begin;
                calls.back().boarded = count(row, DoorColumn::boarded);
                calls.back().alighted = count(row, DoorColumn::alighted);
                calls.back().aboard = count(row, DoorColumn::aboard);
            }
            if (stood && !stands && !opened) calls.pop_back();  // it stood somewhere else
            stood = stands;
        }
        if (stood && !opened) calls.pop_back();
    }
    std::ranges::stable_sort(calls, {}, &VehicleCall::begin);
    return calls;
}

}  // namespace throng::analysis
