// SPDX-License-Identifier: Apache-2.0
#include "base/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace throng {
namespace {

std::error_code systemError(int number) {
    return {number, std::generic_category()};
}

/// Calls again while signals come in between.
template <class Call>
auto untilDone(Call&& call) {
    auto result = call();
    while (result < 0 && errno == EINTR)
        result = call();
    return result;
}

/// Above the standard streams, where nothing is in the way of theirs.
Descriptor movedUp(int number) {
    Descriptor low(number);
    if (number > STDERR_FILENO) return low;
    return Descriptor(::fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
}

struct Pipe {
    Descriptor read, write;
};

Pipe makePipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(systemError(errno), "cannot make a pipe");
    // So that who writes megabytes is not waited for every 64 KiB; where it may not be so large, it works,
    // too.
    constexpr int kRoomInPipe = 1 << 20;
    ::fcntl(ends[1], F_SETPIPE_SZ, kRoomInPipe);
    return {movedUp(ends[0]), movedUp(ends[1])};
}

Pipe pipeFor(StandardStream stream) {
    return stream == StandardStream::pipe ? makePipe() : Pipe{};
}

std::vector<std::string> environmentWith(const std::vector<std::pair<std::string, std::string>>& additions) {
    std::vector<std::string> all;
    all.reserve(additions.size());
    for (const auto& [name, value] : additions)
        all.push_back(fmt::format("{}={}", name, value));
    for (char** ours = environ; *ours; ++ours) {
        const std::string_view entry(*ours);
        const bool replaced = std::any_of(additions.begin(), additions.end(), [&](const auto& addition) {
            return entry.substr(0, entry.find('=')) == addition.first;
        });
        if (!replaced) all.emplace_back(entry);
    }
    return all;
}

std::vector<char*> pointersTo(const std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    pointers.reserve(texts.size() + 1);
    for (const std::string& text : texts)
        pointers.push_back(const_cast<char*>(text.c_str()));
    pointers.push_back(nullptr);
    return pointers;
}

/// All that the child needs, made before it is there: between fork and exec nothing may ask for memory, whose
/// lock another thread may have held.
struct Launch {
    const char* file;
    std::vector<char*> words, environment;
    int input, output, errors;  ///< to become its standard streams, unless negative
    int failure;                ///< where to tell why it could not be started
    bool ends_with_us;
    pid_t parent;
};

[[noreturn]] void becomeProgram(const Launch& launch) {
    ::setpgid(0, 0);
    if (launch.ends_with_us) {
        ::prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (::getppid() != launch.parent) ::_exit(1);  // it ended in between
    }
    const int streams[] = {launch.input, launch.output, launch.errors};
    for (int number = 0; number < 3; ++number)
        if (streams[number] >= 0) ::dup2(streams[number], number);
    ::close_range(STDERR_FILENO + 1, ~0u, CLOSE_RANGE_CLOEXEC);  // also what libraries have opened
    ::execvpe(launch.file, launch.words.data(), launch.environment.data());
    const int reason = errno;
    [[maybe_unused]] const ssize_t told = ::write(launch.failure, &reason, sizeof reason);
    ::_exit(127);
}

/// While it lives, SIGPIPE does not reach this thread.
class PipeSignalHeld {
  public:
    PipeSignalHeld() {
        sigset_t pending;
        ::sigpending(&pending);
        was_pending_ = ::sigismember(&pending, SIGPIPE);
        ::sigemptyset(&pipe_);
        ::sigaddset(&pipe_, SIGPIPE);
        ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    ~PipeSignalHeld() {
        const timespec at_once{};
        if (!was_pending_) untilDone([&] { return ::sigtimedwait(&pipe_, nullptr, &at_once); });
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    PipeSignalHeld(const PipeSignalHeld&) = delete;
    PipeSignalHeld& operator=(const PipeSignalHeld&) = delete;

  private:
    sigset_t pipe_, before_;
    bool was_pending_;
};

/// What has come, after waiting for something; nothing at the end.
std::optional<std::string> readSome(int descriptor) {
    char piece[4096];
    const ssize_t got = untilDone([&] { return ::read(descriptor, piece, sizeof piece); });
    if (got <= 0) return std::nullopt;
    return std::string(piece, static_cast<std::size_t>(got));
}

}  // namespace

std::string ProgramEnd::text() const {
    if (signal) return fmt::format("was killed by signal {} ({})", signal, ::strsignal(signal));
    return fmt::format("ended with code {}", code);
}

Process::Process(const std::vector<std::string>& words, const ProcessOptions& options) {
    Pipe input = pipeFor(options.input), output = pipeFor(options.output), errors = pipeFor(options.errors);
    Pipe failure = makePipe();
    const std::vector<std::string> environment = environmentWith(options.environment);
    const std::string& file = options.file.empty() ? words.front() : options.file;
    const Launch launch{file.c_str(),        pointersTo(words),    pointersTo(environment),
                        input.read.get(),    output.write.get(),   errors.write.get(),
                        failure.write.get(), options.ends_with_us, ::getpid()};
    id_ = ::fork();
    if (id_ < 0) throw std::system_error(systemError(errno), "cannot start " + file);
    if (id_ == 0) becomeProgram(launch);

    failure.write.reset();  // the program's own end closes when it begins
    int reason = 0;
    if (untilDone([&] { return ::read(failure.read.get(), &reason, sizeof reason); }) > 0) {
        wait();
        throw std::system_error(systemError(reason), "cannot start " + file);
    }
    input_ = std::move(input.write);
    output_ = std::move(output.read);
    errors_ = std::move(errors.read);
}

Process::~Process() {
    if (id_ < 0) return;
    tell(SIGKILL);
    wait();
}

std::error_code Process::write(std::string_view bytes) {
    const PipeSignalHeld held;
    while (!bytes.empty()) {
        const ssize_t written = untilDone([&] { return ::write(input_.get(), bytes.data(), bytes.size()); });
        if (written < 0) return systemError(errno);
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return {};
}

std::optional<std::string> Process::read() {
    return readSome(output_.get());
}

void Process::tell(int signal) const {
    if (id_ > 0) ::kill(-id_, signal);
}

ProgramEnd Process::wait() {
    closeInput();
    if (id_ < 0) return end_;
    int status = 0;
    untilDone([&] { return ::waitpid(id_, &status, 0); });
    id_ = -1;
    if (WIFSIGNALED(status))
        end_.signal = WTERMSIG(status);
    else
        end_.code = WEXITSTATUS(status);
    return end_;
}

ProgramRun runProgram(const std::vector<std::string>& words) {
    Process process(words, {.output = StandardStream::pipe, .errors = StandardStream::pipe});
    ProgramRun run;
    pollfd sources[] = {{process.output(), POLLIN, 0}, {process.errors(), POLLIN, 0}};
    std::string* texts[] = {&run.output, &run.errors};
    while (sources[0].fd >= 0 || sources[1].fd >= 0) {
        untilDone([&] { return ::poll(sources, std::size(sources), -1); });
        for (std::size_t i = 0; i < std::size(sources); ++i) {
            if (sources[i].fd < 0 || !sources[i].revents) continue;
            if (const std::optional<std::string> piece = readSome(sources[i].fd))
                texts[i]->append(*piece);
            else
                sources[i].fd = -1;
        }
    }
    run.end = process.wait();
    return run;
}

}  // namespace throng
