// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "authoring/scene.h"

namespace throng::sim {

/// A scene without people or walls over [minimum, maximum] metres.
authoring::Scene emptyScene(glm::vec2 minimum, glm::vec2 maximum);

/// Somebody who is there from the start and walks straight to `goal`.
gpu::Person& addPerson(authoring::Scene& scene, glm::vec2 position, glm::vec2 goal, float speed = 1.3f,
                       float radius = 0.25f);

/// `count` people, one per (spacing)^2 square metres, in random order, walking to random places.
authoring::Scene openCrowd(std::uint32_t count, float spacing, std::uint32_t seed);

}  // namespace throng::sim
