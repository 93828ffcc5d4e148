// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "authoring/scene.h"
#include "base/frame.h"
#include "sim/diagram/cost_model.h"
#include "sim/diagram/diagram.h"
#include "sim/diagram/looked_at.h"
#include "sim/gl/shader_source.h"

namespace throng::sim {

/// Steps of the warm-up, before the first frame.
std::uint32_t warmupSteps(const authoring::SimulationSettings& settings);

/// Bytes of a frame as packFrame() writes it.
inline std::size_t bytesOfFrame(std::uint32_t rows) {
    return std::size_t{rows} * 9 * sizeof(float);
}

/// A crowd on the GPU. Needs a current gl::Context and stays on its thread. Nothing is read back inside a
/// step.
class Simulation {
  public:
    /// All that a step hands to the next one.
    struct State {
        std::uint32_t steps_done = 0;
        std::vector<std::pair<std::string, std::vector<std::byte>>> parts;  ///< by name
    };

    /// @param costs what `auto` chooses the diagram's method by
    /// @throws GraphicsError (shaders, memory, a scene too large for the device)
    Simulation(const authoring::Scene& scene, const gl::ShaderLibrary& library,
               const CostModel& costs = CostModel::builtIn());
    ~Simulation();
    Simulation(Simulation&&) noexcept;

    /// Advances by 1 / (fps * substeps) seconds.
    /// @returns false where it was stopped in its middle: nothing but an earlier state is then of use
    bool step();
    /// @param stop tells whether to stop: asked within steps, too, where one of them takes long
    void stopWhen(std::function<bool()> stop);
    bool canStopWithinStep() const;
    std::uint32_t stepsDone() const;
    /// Where the layout leaves the diagram's method open: the best one for so many people from here on. All
    /// that it chooses from give the same diagram, so it matters to nothing but speed.
    /// @param pixels_looked_at by lookedAtCount(), of these people or of not much earlier; 0: nobody has
    /// counted
    void adaptTo(std::uint32_t people_present, double pixels_looked_at = 0.0);
    /// None where it would make no difference, and with charts, whose people do not stand where frames say.
    std::optional<LookedAtCount> lookedAtCount() const;
    DiagramMethod diagramMethod() const;
    bool diagramIsPaged() const;

    /// Waits for the device. Between frames: another simulation of the same scene on the same driver that is
    /// given this state goes on to the very same bytes. An earlier state of a simulation's own is for saving
    /// again only.
    State save() const;
    /// @throws std::runtime_error for the state of another scene
    void restore(const State& state);

    /// Waits until the device has done all that was asked.
    void wait() const;

    /// Puts the present frame into `buffer`: positions, directions and states of all rows, three floats each.
    void packFrame(const gl::Buffer& buffer);
    std::size_t frameBytes() const;

    /// Brings the diagram up to the present positions, between frames; the next step builds its own.
    /// @returns false where that was stopped
    bool buildDiagramNow(Extent extent = Extent::everywhere);
    Diagram& diagram();
    /// Puts a stream from the device into `buffer`, three floats a row. Some streams are of the last step and
    /// have to be packed before buildDiagramNow(), others need it: see StreamInfo::needs_diagram.
    void packStream(Stream stream, const gl::Buffer& buffer);

    /// What became of everybody; waits for the device. Steps are turned into frames by the scene's settings.
    Account account() const;

    /// Each pass and how long it takes on average, ms, over `steps` more steps; waits after every pass.
    std::vector<std::pair<std::string, double>> profile(int steps);

    const gpu::Parameters& parameters() const;
    /// How many drive in all of the bake.
    std::size_t vehicles() const;
    std::size_t lifts() const;
    bool hasDoors() const;

    struct Parts;
    /// The passes and their buffers, for tests of single passes.
    Parts& parts();

  private:
    std::unique_ptr<Parts> parts_;
};

}  // namespace throng::sim
