// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "authoring/scene.h"

namespace throng::sim {

/// What a bake asks of the device's memory.
struct MemoryNeeded {
    std::size_t people = 0;  ///< bytes that go with the number of people
    std::size_t scene = 0;   ///< all others: ground, walls, fields, cells
    std::size_t diagram = 0;
    std::size_t frames = 0;  ///< those on their way out
    std::size_t all() const { return people + scene + diagram + frames; }
};

/// Known without a device: buffers are counted as they would be made. Of a bake without images of diagrams.
MemoryNeeded memoryNeeded(const authoring::Scene& scene);

}  // namespace throng::sim
