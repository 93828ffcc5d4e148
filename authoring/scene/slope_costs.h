// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "authoring/terrain/terrain.h"
#include "base/motion_settings.h"

namespace throng::authoring {

/// What walking costs on sloping ground, per metre in plan: the time that it takes there, over that on flat
/// ground, the mean of up and down (Tobler 1993 on slopes, Fruin's shares on stairs:
/// shaders/motion/slope_pace.glsl). Routes that count it lead round a hill where that is quicker. It does not
/// know which way one walks: along a slope costs what straight up and down does.
class SlopeCosts {
  public:
    /// All of it costs 1 where people walk on slopes as on flat ground.
    explicit SlopeCosts(const MotionSettings& motion);
    /// The same, of a terrain: known at each node of its lattice.
    SlopeCosts(const MotionSettings& motion, const Terrain& terrain);

    /// @param slope rise over run
    float of(float slope, bool stairs) const;
    float at(glm::vec2 place) const;
    /// Whether ground costs so much that nobody is sent straight over it without a look at the ways round it:
    /// a slope of 16 % and more.
    bool isWorthAWayRound(glm::vec2 place) const { return at(place) > kWorthAWayRound; }
    /// Whether some of the way from a to b is such ground.
    bool meets(glm::vec2 a, glm::vec2 b) const;

    const std::vector<float>& nodes() const { return nodes_; }
    /// Whether it costs the same everywhere.
    bool isFlat() const;

  private:
    static constexpr float kWorthAWayRound = 1.5f;
    std::vector<float> slopes_[2];  // by slope; of stairs
    glm::vec2 minimum_{0.0f};
    TerrainRaster lattice_;
    std::vector<float> nodes_;
};

}  // namespace throng::authoring
