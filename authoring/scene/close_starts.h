// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "authoring/scene.h"
#include "authoring/scene/fields.h"

namespace throng::authoring {

/// For whose start there is something to look at: which way people face, and so how their bodies lie, is
/// known once there are routes; who is near whom is known before. Of most nobody is, and no wall.
struct CloseStarts {
    static constexpr std::uint8_t kToBody = 1;  ///< another of a formation is so near that bodies may meet
    static constexpr std::uint8_t kToWall = 2;

    std::vector<std::uint8_t> of_row;  ///< flags; zero for who is in no formation

    bool toBody(std::size_t row) const { return (of_row[row] & kToBody) != 0; }
    bool toWall(std::size_t row) const { return (of_row[row] & kToWall) != 0; }
};

/// @param first_group of the formations, which come one after the other
CloseStarts closeStarts(const Scene& scene, const WalkGeometry& geometry, std::size_t first_group,
                        std::size_t groups);

}  // namespace throng::authoring
