// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/bake_reader.h"

namespace throng::analysis {

/// What a vehicle did at a platform.
struct VehicleCall {
    std::string flow;         ///< of vehicles
    std::size_t vehicle = 0;  ///< its number in the bake
    double begin = 0.0;       ///< s: when it stood
    double dwell = 0.0;       ///< s, until it went on, or the bake ended
    std::uint32_t alighted = 0, boarded = 0;
    std::uint32_t aboard = 0;  ///< as it went on
};

/// All that vehicles did at platforms, in the order of their times. Throws InputError.
std::vector<VehicleCall> callsIn(const io::Bake& bake);

}  // namespace throng::analysis
