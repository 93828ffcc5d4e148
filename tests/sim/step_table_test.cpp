// SPDX-License-Identifier: Apache-2.0
// The data flow of whole steps: nothing is read that nothing wrote, and nothing is written for nobody.
#include "sim/step_table.h"

#include <algorithm>
#include <map>
#include <set>

#include "authoring/layout/layout_reader.h"
#include "authoring/scene/scene_builder.h"
#include "base/streams.h"
#include "sim/diagram/bands.h"
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

using Names = std::set<std::string>;
using Commands = std::vector<gl::Command>;
using Buffers = std::set<const gl::Contents*>;

/// Buffers that are read before anything has written them.
Names readUnwritten(const Commands& commands) {
    Names found;
    Buffers written;
    for (const gl::Command& command : commands) {
        for (const gl::Touch& touch : command.touches)
            if (touch.reads && !written.contains(touch.contents.get())) found.insert(touch.contents->name);
        for (const gl::Touch& touch : command.touches)
            if (touch.writes) written.insert(touch.contents.get());
    }
    return found;
}

/// Buffers that are written from command number `first` on, and that nothing reads afterwards.
Names writtenForNobody(const Commands& commands, std::size_t first) {
    Buffers written, read;
    Names found;
    for (std::size_t i = first; i < commands.size(); ++i) {
        for (const gl::Touch& touch : commands[i].touches)
            if (touch.reads && written.contains(touch.contents.get())) read.insert(touch.contents.get());
        for (const gl::Touch& touch : commands[i].touches)
            if (touch.writes) written.insert(touch.contents.get());
    }
    for (const gl::Contents* contents : written)
        if (!read.contains(contents)) found.insert(contents->name);
    return found;
}

TEST(DataFlow, IsFollowedFromCommandToCommand) {
    const auto named = [](const char* name) {
        return std::make_shared<const gl::Contents>(gl::Contents{name, "person", 4});
    };
    const auto input = named("input"), middle = named("middle"), sum = named("sum"), lost = named("lost");
    const Commands once = {
        {"", "", "upload", {{input, false, true}}},
        {"", "x", "shaders/a", {{input, true, false}, {middle, false, true}}},
        {"", "x", "shaders/b", {{middle, true, false}, {sum, true, true}, {lost, false, true}}}};
    EXPECT_EQ(readUnwritten(once), Names{"sum"});
    EXPECT_EQ(writtenForNobody(once, 0), (Names{"lost", "sum"}));
    Commands twice = once;
    twice.insert(twice.end(), once.begin(), once.end());
    EXPECT_EQ(writtenForNobody(twice, 0), Names{"lost"});  // a sum goes on in the next step
    EXPECT_EQ(writtenForNobody(twice, 5), (Names{"lost", "sum"}));
}

/// People who enter little by little round a wall, a line to wait in, a gate, jams that routes heed.
const std::string kEverything = R"({"throng": 1, "simulation": {"duration": 10, "method": "binned"},
 "roads": [{"id": "street", "centreline": [[-12, 0], [12, 0]], "width": 8}],
 "areas": [{"id": "stand", "polygon": [[-4, 1], [4, 1], [4, 4], [-4, 4]]}],
 "walls": [{"points": [[-3, -1], [3, -1]], "thickness": 0.3},
           {"id": "gate", "points": [[-6, -4], [-6, -1]]}],
 "events": [{"at": 0.2, "open": "gate"}],
 "flows": [{"id": "f", "from": "street:start", "to": "street:end", "count": 20, "end": 1,
            "people": {"body": "disc"}},
           {"id": "g", "from": "street:end", "to": "street:start", "count": 10, "end": 1,
            "people": {"body": "disc"},
            "via": [{"at": "stand", "activity": "queue", "line": [[3, 3], [-3, 3]], "wait": 1}]}]})";

class StepTableTest : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        scene = sceneOf(kEverything);
        library.keepPrograms();
    }
    static authoring::Scene sceneOf(const std::string& text) {
        authoring::Diagnostics diagnostics;
        const auto layout = authoring::readLayout(text, {}, diagnostics);
        return authoring::buildScene(layout.value(), diagnostics).value();
    }
    void TearDown() override {
        library = gl::ShaderLibrary();  // its programs go before the context
        GpuTest::TearDown();
    }

    /// All that may be asked of a crowd besides steps.
    static void lookAtEverything(sim::Simulation& simulation) {
        gl::Buffer frame("frame", simulation.frameBytes());
        simulation.packFrame(frame);
        frame.download<float>(1);
        simulation.buildDiagramNow();
        sim::Diagram& diagram = simulation.diagram();
        gl::Buffer stream("stream", std::size_t{12} * simulation.parameters().row_count);
        for (const StreamInfo& info : kStreams) {
            if (info.source != StreamSource::device) continue;
            simulation.packStream(info.id, stream);
            stream.download<float>(1);
        }
        diagram.measureDistances().download<float>(1);
        diagram.findSeconds().download<float>(1);
        simulation.save();
    }

    authoring::Scene scene;
};

TEST_F(StepTableTest, HasNoPassThatReadsWhatNobodyWroteOrWritesWhatNobodyReads) {
    for (const authoring::DiagramMethodEntry& entry : authoring::kDiagramMethods) {
        SCOPED_TRACE(std::string(entry.word));
        scene.settings.method = entry.method;
        const gl::Journal journal;
        sim::Simulation simulation(scene, library);
        const std::size_t made = journal.commands().size();
        for (int step = 0; step < 60; ++step)
            simulation.step();
        const bool drawn_by_ids = entry.method == sim::DiagramMethod::cones ||
                                  entry.method == sim::DiagramMethod::gradient1 ||
                                  entry.method == sim::DiagramMethod::gradient2 ||
                                  entry.method == sim::DiagramMethod::gradient2_packed;
        // Where sites stand by their ids is for those who draw, and for pictures.
        EXPECT_EQ(writtenForNobody(journal.commands(), made), drawn_by_ids ? Names{} : Names{"site slots"});
        lookAtEverything(simulation);
        EXPECT_EQ(writtenForNobody(journal.commands(), made), Names{});
        EXPECT_EQ(readUnwritten(journal.commands()), Names{});
    }
}

TEST_F(StepTableTest, HoldsForTheOtherWaysToFindNeighbours) {
    for (const auto proximity : {authoring::Proximity::grid, authoring::Proximity::brute}) {
        scene.settings.proximity = proximity;
        const gl::Journal journal;
        sim::Simulation simulation(scene, library);
        const std::size_t made = journal.commands().size();  // with walls in the diagram that nobody asks for
        for (int step = 0; step < 60; ++step)
            simulation.step();
        lookAtEverything(simulation);
        EXPECT_EQ(writtenForNobody(journal.commands(), made), Names{});
        EXPECT_EQ(readUnwritten(journal.commands()), Names{});
    }
}

TEST_F(StepTableTest, HoldsForPeopleWithBodies) {
    std::string text = kEverything;
    for (std::size_t at = 0; (at = text.find("disc", at)) != std::string::npos;)
        text.replace(at, 4, "adult");
    const authoring::Scene bodies = sceneOf(text);
    const gl::Journal journal;
    sim::Simulation simulation(bodies, library);
    const std::size_t made = journal.commands().size();
    for (int step = 0; step < 60; ++step)
        simulation.step();
    lookAtEverything(simulation);
    EXPECT_EQ(writtenForNobody(journal.commands(), made), Names{});
    // Rounds of contact are told of together: the first writes them, the others read.
    EXPECT_EQ(readUnwritten(journal.commands()), Names{"near lists"});
}

TEST_F(StepTableTest, HoldsForTheOtherWaysToKeepADiagram) {
    authoring::Scene pages = scene, bands = scene;
    pages.maximum = {640, 640};
    bands.maximum = {60, 60};
    bands.settings.pixels_per_metre = 16.0;
    for (const bool in_bands : {false, true}) {
        const gl::Journal journal;
        sim::Simulation simulation(in_bands ? bands : pages, library);
        EXPECT_EQ(simulation.diagramIsPaged(), !in_bands);
        EXPECT_EQ(simulation.diagram().bands() != nullptr, in_bands);
        const std::size_t made = journal.commands().size();
        for (int step = 0; step < 60; ++step)
            simulation.step();
        lookAtEverything(simulation);
        EXPECT_EQ(writtenForNobody(journal.commands(), made), Names{}) << in_bands;
        EXPECT_EQ(readUnwritten(journal.commands()), Names{}) << in_bands;
    }
}

TEST_F(StepTableTest, CountsBytesPerPersonAndLaunches) {
    sim::Simulation simulation(scene, library);
    const std::vector<sim::StepPass> table = sim::tabulateStep(simulation);
    const auto pass = [&](const std::string& name) {
        return *std::find_if(table.begin(), table.end(), [&](const auto& each) { return each.name == name; });
    };
    const sim::StepRow gather = pass("cells").rows.back();
    EXPECT_EQ(gather.what, "shaders/cells/bodies_gather.comp");
    EXPECT_NEAR(gather.launches, 0.5, 1e-9)
        << "at every fourth step people decide, and are sorted again once some have come in";
    const std::size_t word = sizeof(std::uint32_t);
    EXPECT_EQ(gather.bytesReadPerPerson(), sizeof(gpu::Person) + sizeof(gpu::AgentState) + 2 * word);
    EXPECT_EQ(gather.bytesWrittenPerPerson(),
              sizeof(gpu::Body) + simulation.parts().buffers.walkers.contents()->element_bytes +
                  sizeof(gpu::DiagramSite) + word);
    std::map<std::string, double> launches;
    for (const sim::StepRow& row : pass("contacts").rows)
        launches[row.what] += row.launches;
    ASSERT_EQ(launches.size(), 2u);
    EXPECT_NEAR(launches["shaders/motion/weigh.comp"], 1.0, 1e-9) << "once a step, for all rounds";
    EXPECT_NEAR(launches["shaders/motion/contact.comp"], scene.settings.contact_iterations, 1e-9);
    EXPECT_NEAR(pass("routes").rows.front().launches, 0.25, 1e-9);
    ASSERT_EQ(pass("motion").rows.size(), 2u);
}

TEST_F(StepTableTest, CallsPassesAsTheirProgramsDo) {
    sim::Simulation simulation(scene, library);
    const std::vector<std::pair<std::string, double>> times = simulation.profile(1);
    const std::vector<sim::StepPass> table = sim::tabulateStep(simulation);
    ASSERT_EQ(table.size(), times.size() + 1);  // the CPU's gates come first
    for (std::size_t i = 0; i < times.size(); ++i) {
        EXPECT_EQ(table[i + 1].name, times[i].first);
        EXPECT_FALSE(table[i + 1].rows.empty()) << times[i].first;
        for (const sim::StepRow& row : table[i + 1].rows)
            EXPECT_TRUE(row.declared.empty() || row.declared == times[i].first) << row.what;
    }
}

TEST_F(StepTableTest, HasPassesThatComeSeveralTimesOnce) {
    const auto once = [&](sim::Simulation& simulation) {
        std::map<std::string, int> names;
        double of_diagram = 0.0;
        for (const sim::StepPass& pass : sim::tabulateStep(simulation)) {
            ++names[pass.name];
            for (const sim::StepRow& row : pass.rows)
                if (row.what == "shaders/diagram/binned.comp") of_diagram += row.launches;
        }
        for (const auto& [name, count] : names)
            EXPECT_EQ(count, 1) << name;
        for (const auto& [name, time] : simulation.profile(1))
            --names[name];
        for (const auto& [name, count] : names)
            EXPECT_EQ(count, name == "gates" ? 1 : 0) << name;
        return of_diagram;
    };
    sim::Simulation whole(scene, library);
    EXPECT_GT(once(whole), 0.0);
    authoring::Scene large = uniformScene(1234, 1.1f, 34);
    large.settings.pixels_per_metre = 28.0;
    sim::Simulation banded(large, library);
    ASSERT_NE(banded.diagram().bands(), nullptr);
    const double per_step = 1.0 / large.settings.stepsPerDecision();
    EXPECT_DOUBLE_EQ(once(banded), per_step * banded.diagram().bands()->count());
}

TEST_F(StepTableTest, LeavesOutPassesThatHaveNothingToDo) {
    for (gpu::Person& person : scene.people)
        person.flags |= gpu::PERSON_PRESENT_AT_START;
    scene.lines.clear();
    scene.detours = {};
    scene.gate_moves.clear();
    scene.settings.proximity = authoring::Proximity::grid;
    sim::Simulation simulation(scene, library);
    Names idle;
    for (const sim::StepPass& pass : sim::tabulateStep(simulation))
        if (pass.rows.empty()) idle.insert(pass.name);
    EXPECT_EQ(idle, (Names{"routes", "spawn", "gates"}));
}

}  // namespace
}  // namespace throng::test
