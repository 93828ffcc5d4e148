// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/batch_local.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <map>
#include <optional>
#include <thread>

#include "base/process.h"
#include "base/stopwatch.h"
#include "cli/batch/batch_worker.h"
#include "sim/gl/context.h"

namespace throng::cli {
namespace {

/// KiB that the system could still give, from /proc/meminfo; nothing where it does not tell.
std::optional<double> availableMemory() {
    std::ifstream file("/proc/meminfo");
    std::string key, unit;
    double value = 0.0;
    while (file >> key >> value && std::getline(file, unit))
        if (key == "MemAvailable:") return value;
    return std::nullopt;
}

std::vector<int> realGpus() {
    std::vector<int> found;
    for (const gl::Device& device : gl::listDevices())
        if (device.usable && !device.software) found.push_back(device.index);
    return found;
}

ProcessOptions workerOptions(std::size_t render_threads, double people) {
    ProcessOptions options;
    options.file = "/proc/self/exe";
    options.input = options.output = StandardStream::pipe;
    options.ends_with_us = true;
    // Small crowds do better without, as Baker has it.
    if (people >= kWorthThreads && !std::getenv("LP_NUM_THREADS"))
        options.environment.emplace_back("LP_NUM_THREADS", std::to_string(render_threads));
    return options;
}

/// A child process that bakes: it is told scenarios, a line each, and answers with a line each.
class Worker {
  public:
    Worker(const BatchFolder& folder, int device, std::size_t render_threads, double people,
           double checkpoint_seconds)
        : process_({"throng", "batch", folder.familyFile().string(), "-o", folder.root().string(), "--worker",
                    "--device", std::to_string(device), "--checkpoint",
                    std::to_string(checkpoint_seconds / 60.0), "--people", fmt::format("{:.0f}", people)},
                   workerOptions(render_threads, people)) {}

    int output() const { return process_.output(); }
    void give(std::size_t index) {
        // A worker that is dead already is noticed when its output ends.
        (void)process_.write(fmt::format("{}\n", index));
        current = index;
        begun = Clock::now();
    }
    void closeInput() { process_.closeInput(); }
    void tell(int signal) const { process_.tell(signal); }

    /// Whole lines that have come. @returns nothing at the end of the output
    std::optional<std::vector<std::string>> readLines() {
        const std::optional<std::string> piece = process_.read();
        if (!piece) return std::nullopt;
        text_ += *piece;
        std::vector<std::string> lines;
        for (std::size_t end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
            lines.push_back(text_.substr(0, end));
            text_.erase(0, end + 1);
        }
        return lines;
    }

    /// Why it ended, in words; waits for it.
    std::string farewell() { return "its process " + process_.wait().text(); }

    std::optional<std::size_t> current;  ///< scenario
    Clock::time_point begun;

  private:
    Process process_;
    std::string text_;
};

class Dispatcher {
  public:
    Dispatcher(const BatchPlan& plan, const BatchFolder& folder, const std::vector<std::size_t>& scenarios,
               const LocalOptions& options, const InterruptGuard& interrupt,
               const std::function<void(std::size_t, std::size_t)>& advance)
        : plan_(plan),
          folder_(folder),
          options_(options),
          interrupt_(interrupt),
          advance_(advance),
          waiting_(scenarios.begin(), scenarios.end()),
          gpus_(options.device >= 0 ? std::vector<int>{options.device} : realGpus()),
          workers_(workersFor(plan, options, scenarios.size())) {}

    LocalOutcome run() {
        for (std::unique_ptr<Worker>& worker : workers_)
            feed(worker);
        while (anybodyAtWork()) {
            if (interrupt_.signal() && !outcome_.signal) stopAll(interrupt_.signal());
            if (isOver() && !outcome_.out_of_time) {
                outcome_.out_of_time = true;
                stopAll(0);
            }
            if (stopping_ && secondsSince(stopped_at_) > kPatience)
                for (std::unique_ptr<Worker>& worker : workers_)
                    if (worker) worker->tell(SIGKILL);
            listen();
        }
        outcome_.out_of_time = outcome_.out_of_time || (!waiting_.empty() && !outcome_.signal);
        return outcome_;
    }

  private:
    static constexpr double kPatience = 8.0;  // s for a worker to stop by itself
    static constexpr double kPoll = 0.2;      // s

    bool anybodyAtWork() const {
        return std::any_of(workers_.begin(), workers_.end(),
                           [](const auto& worker) { return worker != nullptr; });
    }
    bool isOver() const {
        return options_.seconds_left > 0.0 && secondsSince(start_) >= options_.seconds_left;
    }
    /// Whether another scenario would still end in time, if it takes as long as the longest so far.
    bool hasTime() const {
        return options_.seconds_left <= 0.0 || secondsSince(start_) + 1.2 * longest_ < options_.seconds_left;
    }

    void feed(std::unique_ptr<Worker>& worker) {
        if (waiting_.empty() || stopping_ || !hasTime()) {
            if (worker) worker->closeInput();  // it ends by itself
            return;
        }
        if (!worker) worker = start(static_cast<std::size_t>(&worker - workers_.data()));
        worker->give(waiting_.front());
        waiting_.pop_front();
    }

    std::unique_ptr<Worker> start(std::size_t place) const {
        const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
        const std::size_t threads = cores / workers_.size() > 1 ? cores / workers_.size() : 0;
        const int device = gpus_.empty() ? -1 : gpus_[place % gpus_.size()];
        return std::make_unique<Worker>(folder_, device, threads, plan_.load().largest_people,
                                        options_.checkpoint_seconds);
    }

    void stopAll(int signal) {
        outcome_.signal = signal;
        stopping_ = true;
        stopped_at_ = Clock::now();
        for (std::unique_ptr<Worker>& worker : workers_)
            if (worker) worker->tell(SIGTERM);
    }

    void listen() {
        std::vector<pollfd> sources;
        std::vector<std::unique_ptr<Worker>*> listened;
        for (std::unique_ptr<Worker>& worker : workers_)
            if (worker) {
                sources.push_back({worker->output(), POLLIN, 0});
                listened.push_back(&worker);
            }
        if (::poll(sources.data(), sources.size(), static_cast<int>(1000.0 * kPoll)) <= 0) return;
        for (std::size_t i = 0; i < sources.size(); ++i)
            if (sources[i].revents) hear(*listened[i]);
    }

    void hear(std::unique_ptr<Worker>& worker) {
        const auto lines = worker->readLines();
        if (!lines) return bury(worker);
        for (const std::string& line : *lines) {
            longest_ = std::max(longest_, secondsSince(worker->begun));
            worker->current.reset();
            if (line == "done") ++outcome_.done;
            if (line == "failed") ++outcome_.failed;
            advance_(outcome_.done, outcome_.failed);
            feed(worker);
        }
    }

    void bury(std::unique_ptr<Worker>& worker) {
        const std::optional<std::size_t> lost = worker->current;
        const std::string reason = worker->farewell();
        worker.reset();
        if (!lost || stopping_) return;
        if (deaths_[*lost]++ == 0) {
            waiting_.push_front(*lost);
        } else {
            recordDeath(plan_, *lost, folder_, reason);
            ++outcome_.failed;
            advance_(outcome_.done, outcome_.failed);
        }
        feed(worker);
    }

    const BatchPlan& plan_;
    const BatchFolder& folder_;
    const LocalOptions& options_;
    const InterruptGuard& interrupt_;
    const std::function<void(std::size_t, std::size_t)>& advance_;
    std::deque<std::size_t> waiting_;
    std::vector<int> gpus_;
    std::vector<std::unique_ptr<Worker>> workers_;
    std::map<std::size_t, int> deaths_;
    LocalOutcome outcome_;
    Clock::time_point start_ = Clock::now(), stopped_at_;
    double longest_ = 0.0;  // s, of all scenarios so far
    bool stopping_ = false;
};

}  // namespace

std::size_t workersFor(const BatchPlan& plan, const LocalOptions& options, std::size_t scenarios) {
    constexpr std::size_t kPerGpu = 2;              // one sets up and writes while the other simulates
    constexpr double kBaseMemory = 300.0 * 1024.0;  // KiB of a process with a context
    constexpr double kPersonMemory = 4.0;  // KiB: on the device, in the writers' buffers, in measuring
    const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
    std::size_t count = options.workers;
    if (count == 0) {
        const std::size_t gpus = options.device >= 0 ? 0 : realGpus().size();
        count = gpus > 0 ? std::min(cores, gpus * kPerGpu) : cores;
        if (const std::optional<double> memory = availableMemory()) {
            const double each = kBaseMemory + kPersonMemory * plan.load().largest_people;
            count = std::min(count, static_cast<std::size_t>(std::max(1.0, 0.8 * *memory / each)));
        }
    }
    return std::clamp<std::size_t>(count, 1, std::max<std::size_t>(scenarios, 1));
}

LocalOutcome runLocally(const BatchPlan& plan, const BatchFolder& folder,
                        const std::vector<std::size_t>& scenarios, const LocalOptions& options,
                        const InterruptGuard& interrupt,
                        const std::function<void(std::size_t, std::size_t)>& advance) {
    return Dispatcher(plan, folder, scenarios, options, interrupt, advance).run();
}

}  // namespace throng::cli
