// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "io/crowd_reader.h"

namespace throng::cli {

/// Whom to follow through a bake's layout, simulated anew.
struct FollowRequest {
    std::vector<std::uint32_t> rows;
    double from = 0.0;                                    ///< s
    double to = std::numeric_limits<double>::infinity();  ///< s; at most the bake's end
    std::string folder;                                   ///< for tables and plots; empty: none
    int device = -1;
    bool json = false;
};

/// Prints what the rules of motion made of some people. @throws CLI::ValidationError, InputError, OutputError
void followPeople(io::CrowdReader& crowd, const FollowRequest& request);

}  // namespace throng::cli
