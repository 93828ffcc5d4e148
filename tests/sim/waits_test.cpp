// SPDX-License-Identifier: Apache-2.0
#include <epoxy/gl.h>

#include <map>
#include <string>

#include "sim/frame_pump.h"
#include "sim/simulation_parts.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/layout_scene.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

std::map<std::string, int> calls;

/// Whether a call makes the CPU wait.
template <class... Arguments>
bool waits(Arguments...) {
    return true;
}
/// A fence that is only asked, with no time to wait for it, is none of that.
bool waits(GLsync, GLbitfield, GLuint64 timeout) {
    return timeout > 0;
}

/// While one lives, calls of a function of OpenGL that wait are counted on their way.
template <auto& Function, class Type = std::remove_reference_t<decltype(Function)>>
class Counted;

template <auto& Function, class Result, class... Arguments>
class Counted<Function, Result (*)(Arguments...)> {
  public:
    explicit Counted(const char* name) {
        name_ = name;
        real_ = Function;
        Function = &count;
    }
    ~Counted() { Function = real_; }
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;

  private:
    static Result count(Arguments... arguments) {
        if (waits(arguments...)) ++calls[name_];
        return real_(arguments...);
    }
    static inline std::string name_;
    static inline Result (*real_)(Arguments...) = nullptr;
};

/// All that makes the CPU wait for the device, or brings something back from it.
class Trace {
  public:
    Trace() { calls.clear(); }

  private:
    Counted<epoxy_glFinish> finish_{"glFinish"};
    Counted<epoxy_glFlush> flush_{"glFlush"};
    Counted<epoxy_glClientWaitSync> wait_{"glClientWaitSync"};
    Counted<epoxy_glGetSynciv> sync_{"glGetSynciv"};
    Counted<epoxy_glGetBufferSubData> sub_data_{"glGetBufferSubData"};
    Counted<epoxy_glGetNamedBufferSubData> named_data_{"glGetNamedBufferSubData"};
    Counted<epoxy_glMapBuffer> map_{"glMapBuffer"};
    Counted<epoxy_glMapBufferRange> map_range_{"glMapBufferRange"};
    Counted<epoxy_glMapNamedBuffer> map_named_{"glMapNamedBuffer"};
    Counted<epoxy_glMapNamedBufferRange> map_named_range_{"glMapNamedBufferRange"};
    Counted<epoxy_glReadPixels> pixels_{"glReadPixels"};
    Counted<epoxy_glGetTexImage> image_{"glGetTexImage"};
    Counted<epoxy_glGetTextureImage> texture_image_{"glGetTextureImage"};
    Counted<epoxy_glGetQueryObjectuiv> query_{"glGetQueryObjectuiv"};
    Counted<epoxy_glGetQueryObjectui64v> query64_{"glGetQueryObjectui64v"};
};

std::string textOf(const std::map<std::string, int>& counted) {
    std::string text;
    for (const auto& [name, count] : counted)
        text += name + " " + std::to_string(count) + " times; ";
    return text;
}

class WaitsTest : public GpuTest {
  protected:
    /// What is called in so many steps, once programs are compiled.
    std::map<std::string, int> callsInSteps(const authoring::Scene& scene, int steps) {
        sim::Simulation simulation(scene, library);
        for (int i = 0; i < steps; ++i)
            simulation.step();
        const Trace trace;
        for (int i = 0; i < steps; ++i)
            simulation.step();
        return calls;
    }
};

TEST_F(WaitsTest, TheTraceSeesWhatWaits) {
    const authoring::Scene scene = uniformScene(63, 2.0f, 1);
    sim::Simulation simulation(scene, library);
    simulation.step();
    simulation.parts().buffers.states.download<gpu::AgentState>(1);  // the functions are looked up
    simulation.wait();
    const Trace trace;
    simulation.parts().buffers.states.download<gpu::AgentState>(1);
    simulation.wait();
    EXPECT_EQ(calls["glGetNamedBufferSubData"], 1);
    EXPECT_EQ(calls["glFinish"], 1);
}

TEST_F(WaitsTest, NoStepReadsBackOrWaits) {
    for (const std::uint32_t count : {1u, 63u, 1234u})
        for (const authoring::Proximity proximity :
             {authoring::Proximity::voronoi, authoring::Proximity::grid}) {
            authoring::Scene scene = uniformScene(count, 2.0f, count);
            scene.settings.proximity = proximity;
            const auto found = callsInSteps(scene, 10);
            EXPECT_TRUE(found.empty()) << count << " people: " << textOf(found);
        }
}

/// Everything that layouts have: storeys and lifts, signals and vehicles, platforms, behaviours, seats,
/// gates.
TEST_F(WaitsTest, NoStepOfAnExampleReadsBackOrWaits) {
    for (const char* name :
         {"intersection", "station-levels", "zebra", "tram-stop", "market", "stadium-wave"}) {
        const auto found = callsInSteps(sceneOfExample(name), 60);
        EXPECT_TRUE(found.empty()) << name << ": " << textOf(found);
    }
}

/// As many frames as may be under way are asked for without anybody waiting for one of them; from then on,
/// for the oldest at most.
TEST_F(WaitsTest, FramesComeWithoutAnybodyWaitingForThem) {
    const authoring::Scene scene = uniformScene(1234, 2.0f, 9);
    sim::Simulation simulation(scene, library);
    int received = 0;
    const auto submit = [&](sim::FramePump& pump, std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t frame = first; frame < first + count; ++frame) {
            simulation.step();
            pump.submit(frame, false);
        }
    };
    {  // functions are looked up
        sim::FramePump pump(simulation, {}, [](const Frame&) {});
        submit(pump, 0, 1);
        pump.finish();
    }
    sim::FramePump pump(simulation, {}, [&](const Frame&) { ++received; });
    const std::uint32_t kAtOnce = sim::framesUnderWay(simulation.parameters().row_count);
    constexpr std::uint32_t kMore = 24;
    {
        const Trace trace;
        submit(pump, 0, kAtOnce);
        EXPECT_TRUE(calls.empty()) << textOf(calls);
    }
    {
        const Trace trace;
        submit(pump, kAtOnce, kMore);
        EXPECT_LE(calls["glClientWaitSync"], static_cast<int>(kMore));
        calls.erase("glClientWaitSync");
        EXPECT_TRUE(calls.empty()) << textOf(calls);
    }
    pump.finish();
    EXPECT_EQ(received, static_cast<int>(kAtOnce + kMore));
}

}  // namespace
}  // namespace throng::test
