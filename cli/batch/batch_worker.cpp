// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/batch_worker.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <iostream>

#include "analysis/measure/measure.h"
#include "authoring/layout/layout_reader.h"
#include "base/build_name.h"
#include "base/stopwatch.h"
#include "cli/baking/judge.h"
#include "sim/gl/context.h"

namespace throng::cli {
namespace {

using nlohmann::ordered_json;

/// Tells how long each part took, one after the other.
class Laps {
  public:
    void end(const char* name) {
        const Clock::time_point now = Clock::now();
        laps_[name] = std::round(1.0e6 * std::chrono::duration<double>(now - last_).count()) / 1.0e6;
        last_ = now;
    }
    void set(const char* name, double seconds) { laps_[name] = std::round(1.0e6 * seconds) / 1.0e6; }
    ordered_json json() const {
        ordered_json all = laps_;
        all["total"] = std::round(1.0e6 * std::chrono::duration<double>(last_ - start_).count()) / 1.0e6;
        return all;
    }

  private:
    Clock::time_point start_ = Clock::now(), last_ = start_;
    ordered_json laps_ = ordered_json::object();
};

std::string hostName() {
    char name[256] = {};
    return ::gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

double peakMemoryMebibytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

ordered_json headOf(const BatchPlan& plan, std::size_t index, const std::string& input) {
    const PlannedScenario& planned = plan.scenarios().at(index);
    ordered_json result;
    result["throng_result"] = 1;
    result["id"] = planned.id;
    result["status"] = "failed";
    result["reason"] = nullptr;
    result["parameters"] = ordered_json::object();
    for (const auto& [name, value] : planned.scenario.parameters)
        result["parameters"][name] = value;
    result["input"] = input;
    result["version"] = THRONG_VERSION;
    result["build"] = buildName();
    result["host"] = hostName();
    result["ended"] = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
    return result;
}

std::string inputOf(const BatchPlan& plan, std::size_t index) try {
    return plan.inputHash(plan.layoutText(index));
} catch (const std::invalid_argument&) {
    return {};
}

void recordFailure(const BatchPlan& plan, std::size_t index, const BatchFolder& folder,
                   const std::string& reason, const std::string& details) {
    const std::string& id = plan.scenarios().at(index).id;
    std::string layout;
    try {
        layout = plan.layoutText(index);
    } catch (const std::invalid_argument& error) {
        layout = error.what();
    }
    folder.writeLog(id, fmt::format("scenario {} ({})\n{}\n\nThe layout, for `throng check`:\n{}", index + 1,
                                    authoring::describe(plan.scenarios()[index].scenario), details, layout));
    ordered_json result = headOf(plan, index, inputOf(plan, index));
    result["reason"] = reason;
    result["log"] = "logs/" + id + ".log";
    folder.writeResult(id, result);
}

/// All that is wrong with a layout, and the first error for the result.
std::pair<std::string, std::string> problemsOf(const LoadedLayout& loaded) {
    std::string first, all;
    for (const authoring::Diagnostic& entry : loaded.diagnostics.entries) {
        if (entry.severity != authoring::Severity::error) continue;
        if (first.empty())
            first = fmt::format("{}{}{}", entry.where.pointer(), entry.where.path.empty() ? "" : ": ",
                                entry.message);
        all += authoring::formatDiagnostic(entry, loaded.diagnostics.file, loaded.text) + "\n";
    }
    return {first, all};
}

}  // namespace

void recordDeath(const BatchPlan& plan, std::size_t index, const BatchFolder& folder,
                 const std::string& reason) {
    recordFailure(plan, index, folder, reason, reason);
}

ScenarioBaker::ScenarioBaker(const BatchPlan& plan, const BatchFolder& folder, const Options& options)
    : plan_(plan), folder_(folder), options_(options), baker_(options.device, "", options.people) {}

ScenarioEnd ScenarioBaker::bake(std::size_t index, const InterruptGuard& interrupt) {
    try {
        return tryBake(index, interrupt);
    } catch (const gl::GraphicsError& error) {
        recordFailure(plan_, index, folder_, error.what(), error.what());
        throw;
    } catch (const OutputBusy&) {
        return ScenarioEnd::failed;  // who bakes it just now writes the result, too
    } catch (const std::exception& error) {
        recordFailure(plan_, index, folder_, error.what(), error.what());
        return ScenarioEnd::failed;
    }
}

ScenarioEnd ScenarioBaker::tryBake(std::size_t index, const InterruptGuard& interrupt) {
    const std::string& id = plan_.scenarios().at(index).id;
    Laps laps;
    const std::string text = plan_.layoutText(index);
    LoadAttempt attempt = tryReadLayout(text, id + ".json", {}, &grounds_);
    laps.end("load");
    if (!attempt.valid) {
        const auto [first, all] = problemsOf(attempt.loaded);
        recordFailure(plan_, index, folder_, first, all);
        return ScenarioEnd::failed;
    }
    BakeJob job;
    job.options.output = folder_.bake(id).string();
    job.options.force = true;
    job.options.gltf = plan_.family().bake.gltf;
    job.options.formats = plan_.family().bake.formats;
    job.streams = plan_.family().bake.streams;
    job.diagram_every = static_cast<std::uint32_t>(plan_.family().bake.diagrams);
    job.checkpoint_seconds = options_.checkpoint_seconds;
    job.resume = true;
    job.when_stopped = [&](int, double seconds) {
        constexpr double kWorthKeeping = 20.0;
        return seconds > kWorthKeeping && options_.checkpoint_seconds > 0.0 ? WhenStopped::checkpoint
                                                                            : WhenStopped::discard;
    };
    const BakeRun run = baker_.bake(attempt.loaded, job, interrupt);
    laps.end("bake");
    laps.set("setup", run.setup_seconds);
    laps.set("simulate", run.timing.wall_seconds);
    // Complete already where an earlier process was killed between its bake and its result.
    if (run.end != BakeRun::End::complete && run.end != BakeRun::End::was_complete)
        return ScenarioEnd::stopped;
    io::CrowdReader crowd(io::loadBake(folder_.bake(id)));
    const auto [measured, missed] = judgeBake(crowd, {});
    laps.end("measure");

    ordered_json result = headOf(plan_, index, plan_.inputHash(text));
    result["status"] = "ok";
    result["missed"] = missed;
    result["metrics"] = analysis::measurementJson(measured);
    result["frames"] = run.frames;
    result["steps"] = run.timing.steps;
    result["device"] = baker_.device().name;
    result["driver"] = baker_.device().version;
    if (plan_.family().bake.keep)
        result["bake"] = "bakes/" + id;
    else
        std::filesystem::remove_all(folder_.bake(id));
    std::error_code ignored;
    std::filesystem::remove(folder_.log(id), ignored);  // of an earlier failure
    laps.end("tidy");
    result["seconds"] = laps.json();
    result["peak_memory_mib"] = std::round(peakMemoryMebibytes());
    folder_.writeResult(id, result);
    return ScenarioEnd::done;
}

void runWorker(const BatchPlan& plan, const BatchFolder& folder, const ScenarioBaker::Options& options) {
    const InterruptGuard interrupt;
    std::signal(SIGPIPE, SIG_IGN);  // where nobody hears of a scenario any more, it is ended all the same
    ScenarioBaker baker(plan, folder, options);
    std::size_t index = 0;
    while (!interrupt.signal() && std::cin >> index) {
        ScenarioEnd end = ScenarioEnd::failed;
        try {
            end = baker.bake(index, interrupt);
        } catch (const gl::GraphicsError&) {
            fmt::print("failed\n");  // a new process may have more luck with the device
            std::fflush(stdout);
            throw;
        }
        fmt::print("{}\n", end == ScenarioEnd::done     ? "done"
                           : end == ScenarioEnd::failed ? "failed"
                                                        : "stopped");
        std::fflush(stdout);
        if (end == ScenarioEnd::stopped) return;
    }
}

}  // namespace throng::cli
