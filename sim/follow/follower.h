// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "authoring/scene.h"
#include "base/followed.h"
#include "sim/simulation.h"

namespace throng::sim {

/// Takes a simulation through its steps and looks at some of its people after each pass, and at what each
/// rule has made of them. The simulation goes the same way as without. Looking waits for the device, again
/// and again.
class Follower {
  public:
    /// @param rows of the people to follow
    Follower(Simulation& simulation, const authoring::Scene& scene, std::vector<std::uint32_t> rows);
    ~Follower();

    /// @returns what became of those of the rows who were there, by row
    std::vector<FollowedStep> step();
    /// Whether all of them have arrived and left before the last step.
    bool allHaveLeft() const;

  private:
    class Eye;
    std::unique_ptr<Eye> eye_;
};

}  // namespace throng::sim
