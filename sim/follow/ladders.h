// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/follow/rungs.h"
#include "sim/simulation_parts.h"

namespace throng::sim {

/// What the rules up to one of them make of everybody.
struct Climb {
    std::string rule;
    std::vector<glm::vec2> values;  ///< by slot, or as is said
    std::vector<glm::vec2>
        axes{};  ///< m, by slot: of bodies there (shaders/shared/body_shape.glsl); targets only
};

/// The same of a decision: targets, m, and how velocities change in each step, m/s.
struct ClimbToDecide {
    Climb target;
    std::vector<glm::vec2> changes;
};

/// The programs of a step by which people decide and move, once for each of their rules: first without any,
/// then with one more at a time, and at last as the step has them. They work from what the step's own
/// programs work from and write to places of their own, so the step goes on as if they were not there.
class Ladders {
  public:
    Ladders(Simulation::Parts& parts, const authoring::Scene& scene);

    /// Before the pass `avoidance`.
    void keepTouchWords();
    /// After it, where people decide: wished velocities, m/s.
    std::vector<Climb> wishes(std::uint32_t slots);
    /// Likewise: what they decide.
    std::vector<ClimbToDecide> decided(std::uint32_t slots);
    /// After it, where they do not decide: targets, m.
    std::vector<Climb> carriedOn(std::uint32_t slots);

    /// Before the pass `contacts`.
    void keepTargets();
    /// After it: targets, m.
    /// @param followed slots that the walls of the last rung matter to
    std::vector<Climb> pushed(std::uint32_t slots, const std::vector<std::uint32_t>& followed);

    /// Before the pass `motion`.
    void keepStates();
    /// After it: where people look, unit vectors, by the order of `rows`.
    std::vector<Climb> turned(std::uint32_t slots, std::uint32_t steps_done,
                              const std::vector<std::uint32_t>& rows);

  private:
    struct Step {
        std::string rule;
        gl::ComputeProgram program;
    };
    struct Round {
        std::string rule;
        Contacts contacts;
    };
    void makeDecisions();
    void makeContacts();
    void makeMotion();
    Climb climbTo(const std::string& rule, const gl::Buffer& targets, std::uint32_t slots) const;

    Simulation::Parts& parts_;
    const TerrainSlopes* ground_;
    gl::Buffer walkers_, wishes_, touch_words_, touched_, targets_, targets_after_, ways_, decisions_;
    gl::Buffer no_jams_, kept_targets_, kept_states_, states_, kept_lines_, lines_, chests_;
    std::vector<Step> steer_, avoid_, carry_on_, move_;
    std::vector<Round> contacts_;
};

}  // namespace throng::sim
