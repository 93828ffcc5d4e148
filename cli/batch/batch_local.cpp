// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/batch_local.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <fstream>
#include <map>
#include <optional>
#include <system_error>
#include <thread>

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

/// A child process that bakes, and two pipes to talk to it.
class Worker {
  public:
    Worker(const BatchFolder& folder, int device, std::size_t render_threads, double people,
           double checkpoint_seconds) {
        int to_child[2], from_child[2];
        if (::pipe2(to_child, O_CLOEXEC) != 0 || ::pipe2(from_child, O_CLOEXEC) != 0)
            throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
        // Everything that needs memory is made before the fork.
        const std::string family = folder.familyFile().string();
        const std::string root = folder.root().string();
        const std::string device_text = std::to_string(device);
        const std::string checkpoint = std::to_string(checkpoint_seconds / 60.0);
        const std::string threads = std::to_string(render_threads);
        const std::string people_text = fmt::format("{:.0f}", people);
        const pid_t parent = ::getpid();
        pid_ = ::fork();
        if (pid_ < 0) throw std::system_error(errno, std::generic_category(), "cannot start a worker");
        if (pid_ == 0) {
            ::prctl(PR_SET_PDEATHSIG, SIGTERM);
            if (::getppid() != parent) ::_exit(1);  // it died in between
            ::setpgid(0, 0);  // Ctrl-C is the parent's, which tells its children in time
            ::dup2(to_child[0], STDIN_FILENO);
            ::dup2(from_child[1], STDOUT_FILENO);
            // Small crowds do better without, as Baker has it.
            if (people >= kWorthThreads) ::setenv("LP_NUM_THREADS", threads.c_str(), 0);
            ::execl("/proc/self/exe", "throng", "batch", family.c_str(), "-o", root.c_str(), "--worker",
                    "--device", device_text.c_str(), "--checkpoint", checkpoint.c_str(), "--people",
                    people_text.c_str(), static_cast<char*>(nullptr));
            ::_exit(127);
        }
        ::close(to_child[0]);
        ::close(from_child[1]);
        input_ = to_child[1];
        output_ = from_child[0];
    }
    ~Worker() {
        closeInput();
        ::close(output_);
        if (pid_ > 0) {
            ::kill(pid_, SIGKILL);
            ::waitpid(pid_, nullptr, 0);
        }
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    int output() const { return output_; }
    bool idle() const { return !current; }
    void give(std::size_t index) {
        const std::string line = fmt::format("{}\n", index);
        // A worker that is dead already is noticed when its output ends.
        [[maybe_unused]] const ssize_t written = ::write(input_, line.data(), line.size());
        current = index;
        begun = Clock::now();
    }
    void closeInput() {
        if (input_ >= 0) ::close(std::exchange(input_, -1));
    }
    void tell(int signal) const { ::kill(pid_, signal); }

    /// Whole lines that have come. @returns nothing at the end of the output
    std::optional<std::vector<std::string>> readLines() {
        char piece[256];
        const ssize_t got = ::read(output_, piece, sizeof piece);
        if (got <= 0) return std::nullopt;
        text_.append(piece, static_cast<std::size_t>(got));
        std::vector<std::string> lines;
        for (std::size_t end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
            lines.push_back(text_.substr(0, end));
            text_.erase(0, end + 1);
        }
        return lines;
    }

    /// Why it ended, in words; waits for it.
    std::string farewell() {
        int status = 0;
        ::waitpid(std::exchange(pid_, -1), &status, 0);
        if (WIFSIGNALED(status))
            return fmt::format("its process was killed by signal {} ({})", WTERMSIG(status),
                               ::strsignal(WTERMSIG(status)));
        return fmt::format("its process ended with code {}", WEXITSTATUS(status));
    }

    std::optional<std::size_t> current;  ///< scenario
    Clock::time_point begun;

  private:
    pid_t pid_ = -1;
    int input_ = -1, output_ = -1;
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
        struct Guard {  // writing to a worker that has just died must not end us
            void (*before)(int) = ::signal(SIGPIPE, SIG_IGN);
            ~Guard() { ::signal(SIGPIPE, before); }
        } const guard;
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
