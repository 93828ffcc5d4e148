// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/behaviour.h"
#include "sim/boarding.h"
#include "sim/buffers.h"
#include "sim/cell_sort.h"
#include "sim/congestion.h"
#include "sim/diagram/diagram.h"
#include "sim/gates.h"
#include "sim/given.h"
#include "sim/hiding.h"
#include "sim/kept_decision.h"
#include "sim/lifts.h"
#include "sim/passes.h"
#include "sim/patches.h"
#include "sim/seats.h"
#include "sim/sensing.h"
#include "sim/simulation.h"
#include "sim/sizes.h"
#include "sim/traffic.h"

namespace throng::sim {

/// One pass of a step: its name, as its programs declare it, and what runs it. Some run only where people
/// decide.
struct Pass {
    std::string name;
    std::function<void()> run;
};

/// How a scene's diagram is built.
DiagramOptions diagramOptions(const authoring::Scene& scene, const gpu::Parameters& parameters,
                              const Buffers& buffers);

/// What its way is chosen by, before anybody is there.
DiagramLoad diagramLoad(const authoring::Scene& scene, const gpu::Parameters& parameters);

struct Simulation::Parts {
    Parts(const authoring::Scene& scene, const gl::ShaderLibrary& shader_library,
          const CostModel& cost_model);

    gl::ShaderLibrary library;
    authoring::SimulationSettings settings;
    gpu::Parameters parameters;
    Buffers buffers;
    Diagram diagram;
    CellSort cells;
    KeptDecision kept;
    std::optional<Behaviour> behaviour;  // none where nobody has one
    Congestion congestion;
    Spawner spawner;
    Sensing sensing;
    std::optional<Hiding> hiding;         // none where walls hide nobody
    std::optional<TerrainSlopes> slopes;  // none on flat ground
    std::optional<Seams> seams;           // none without charts
    std::optional<Lifts> lifts;           // none without lifts
    std::optional<Boarding> boarding;     // none without doors of vehicles
    std::optional<Patches> patches;       // none where nobody walks at another pace
    std::optional<Sizes> sizes;           // none where nobody takes another room
    std::optional<Given> given;           // none without given people
    std::optional<Seats> seats;           // none where nobody walks to a seat or leaves one
    std::vector<float> platform_sides;    // above 0: left
    Avoidance avoidance;
    Contacts contacts;
    Motion motion;
    WaitingLines lines;
    Gates gates;
    std::optional<Traffic> traffic;  // none without signals and vehicles
    gl::ComputeProgram pack;
    PerStream<std::optional<gl::ComputeProgram>> pack_streams;  // made at the first asking

    CostModel costs;
    DiagramLoad load;                    // of the present population
    double look = 0.0;                   // px: how far people look at the diagram
    DiagramPlan chosen;                  // among costs, where the layout leaves it open
    Extent extent = Extent::everywhere;  // of the diagram that people sense with
    bool stopped = false;                // a step was, in its middle

    std::uint32_t rows = 0;
    std::uint32_t steps_done = 0;
    bool decides = true;      // in this step people look round
    float step_start = 0.0f;  // s, simulation time
    bool anybody_enters_later;
    std::vector<Pass> passes;  // of a step, in order; they refer to this

    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;

    /// What the CPU does before the passes of a step.
    void beginStep();
    std::vector<Pass> passesOfStep();
    /// From people as they are sorted to lists of those near them: the diagram and sensing, band by band
    /// where the diagram is kept so.
    std::vector<Pass> passesOfLooking();
    /// These, one after the other, out of a step.
    void lookRound();

    /// Whether people look round in the step after so many.
    bool decidesAfter(std::uint32_t steps) const {
        return steps % static_cast<std::uint32_t>(settings.stepsPerDecision()) == 0;
    }
    /// What lives on after so many steps; everything else is worked out anew in the next.
    std::vector<std::pair<std::string, gl::Buffer*>> remembered(std::uint32_t steps);

    /// Simulation time at the start of the coming step, s; negative during the warm-up.
    float now() const;
    /// The same, at the end of the present step.
    float endOfStep() const { return timeAfter(steps_done); }
    float timeAfter(std::uint32_t steps) const;
    void changeWishes();
};

}  // namespace throng::sim
