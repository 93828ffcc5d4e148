// SPDX-License-Identifier: Apache-2.0
#include "cli/batch/subprocess.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace throng::cli {
namespace {

struct Pipe {
    int read = -1, write = -1;
    Pipe() {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0)
            throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
        read = ends[0];
        write = ends[1];
    }
    ~Pipe() {
        ::close(read);
        if (write >= 0) ::close(write);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void closeWrite() {
        ::close(write);
        write = -1;
    }
};

void readBoth(const Pipe& a, std::string& text_a, const Pipe& b, std::string& text_b) {
    pollfd sources[2] = {{a.read, POLLIN, 0}, {b.read, POLLIN, 0}};
    std::string* texts[2] = {&text_a, &text_b};
    while (sources[0].fd >= 0 || sources[1].fd >= 0) {
        if (::poll(sources, 2, -1) < 0 && errno != EINTR) return;
        for (int i = 0; i < 2; ++i) {
            if (sources[i].fd < 0 || !sources[i].revents) continue;
            char piece[4096];
            const ssize_t got = ::read(sources[i].fd, piece, sizeof piece);
            if (got > 0)
                texts[i]->append(piece, static_cast<std::size_t>(got));
            else if (got == 0 || errno != EINTR)
                sources[i].fd = -1;
        }
    }
}

}  // namespace

ProgramOutput runProgram(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (const std::string& word : words)
        arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    Pipe out, error;
    const pid_t child = ::fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot start " + words.front());
    if (child == 0) {
        ::setpgid(0, 0);  // Ctrl-C is ours to handle
        ::dup2(out.write, STDOUT_FILENO);
        ::dup2(error.write, STDERR_FILENO);
        ::execvp(arguments.front(), arguments.data());
        ::_exit(127);
    }
    out.closeWrite();
    error.closeWrite();
    ProgramOutput result;
    readBoth(out, result.output, error, result.errors);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

}  // namespace throng::cli
