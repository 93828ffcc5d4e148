// SPDX-License-Identifier: Apache-2.0
#include "cli/watch/live_run.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <utility>

#include "analysis/live/moments.h"
#include "cli/baking/frame_maker.h"
#include "io/under_way.h"
#include "io/vehicle_file.h"

namespace throng::cli {
namespace {

constexpr double kTellsEvery = 0.25;  // s

/// A bake's description, of what is asked for only where moments depend on it.
recording::BakeDescription describe(const LoadedLayout& loaded, const gl::Device& device) {
    BakeOptions options;
    options.output = ".";
    options.gltf = false;
    recording::BakeDescription description = describeBake(loaded, options, device);
    askForBodies(description);
    return description;
}

/// One crowd, while it is simulated.
class Live {
  public:
    Live(const Baker& baker, const LoadedLayout& loaded, double per_second, LiveLog& log)
        : description_(describe(loaded, baker.device())),
          expected_(io::expectedBake(description_)),
          packer_(expected_.bake, per_second),
          log_(log),
          simulation_(baker.simulate(loaded.scene)),
          maker_(
              simulation_, loaded.scene.settings, description_, {},
              [this](const Frame& frame) { keepVehicles(frame); },
              [this](const Frame& frame) { show(frame); }) {}

    LiveEnd simulate(const std::function<bool()>& stop) {
        log_.begin(packer_.about(expected_.people, true));
        simulation_.stopWhen(stop);
        const auto goes_on = [&] {
            tell("warming up", false);
            return !stop();
        };
        tell("warming up", true);
        if (!maker_.warmUp(goes_on)) return LiveEnd::stopped;
        for (std::uint32_t frame = 0; frame < description_.frames && !full_; ++frame) {
            if (stop() || !maker_.makeFrame(frame)) return LiveEnd::stopped;
            made_ = frame + 1;
            tell("simulating", false);
        }
        maker_.wait();
        if (!full_) maker_.finish();
        tell(full_ ? "full" : "complete", true);
        return full_ ? LiveEnd::full : LiveEnd::complete;
    }

  private:
    void keepVehicles(const Frame& frame) {
        if (!frame.vehicles.empty()) vehicles_.emplace_back(frame.vehicles.begin(), frame.vehicles.end());
    }

    void show(const Frame& frame) {
        std::vector<float> vehicles;
        if (!vehicles_.empty()) {
            vehicles = std::move(vehicles_.front());
            vehicles_.pop_front();
        }
        if (full_ || !packer_.wants(frame.index)) return;
        places_.assign(frame[Stream::pos].begin(), frame[Stream::pos].end());
        description_.toOutput(places_);
        if (!vehicles.empty()) vehicles = io::placedVehicles(description_, vehicles, 1);
        full_ = !log_.add(packer_.pack(frame.index, places_, frame[Stream::state], vehicles));
    }

    void tell(const char* state, bool at_once) {
        if (!at_once && secondsSince(told_) < kTellsEvery) return;
        told_ = Clock::now();
        const std::uint32_t steps = simulation_.stepsDone(), warmup = maker_.warmUpSteps();
        log_.tell({{"state", state},
                   {"frame", made_},
                   {"frames", description_.frames},
                   {"people", maker_.present()},
                   {"warmup", warmup > 0 ? std::min(1.0, static_cast<double>(steps) / warmup) : 1.0},
                   {"steps_per_second", steps / std::max(secondsSince(begin_), 1.0e-3)},
                   {"steps_per_frame", maker_.substeps()}});
    }

    recording::BakeDescription description_;
    io::ExpectedBake expected_;
    analysis::MomentPacker packer_;
    LiveLog& log_;
    std::uint32_t made_ = 0;
    Clock::time_point begin_ = Clock::now(), told_{};
    std::deque<std::vector<float>> vehicles_;  // of frames that have not been shown
    std::vector<float> places_;
    std::atomic<bool> full_ = false;
    sim::Simulation simulation_;
    FrameMaker maker_;  // last: its thread uses the others
};

}  // namespace

LiveEnd simulateLive(const Baker& baker, const LoadedLayout& loaded, double per_second, LiveLog& log,
                     const std::function<bool()>& stop) {
    Live live(baker, loaded, per_second, log);
    baker.context().check("setting up the simulation");
    const LiveEnd end = live.simulate(stop);
    baker.context().check("simulating");
    return end;
}

}  // namespace throng::cli
