// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/files/descriptor.h"

namespace throng {

/// How a program ended.
struct ProgramEnd {
    int code = 0;    ///< its exit code, unless a signal killed it
    int signal = 0;  ///< that killed it, or 0

    bool isGood() const { return code == 0 && signal == 0; }
    /// Reads after "it", e.g. "ended with code 3".
    std::string text() const;
};

enum class StandardStream { ours, pipe };

struct ProcessOptions {
    std::string file = {};  ///< to run, where it is another than the first word says
    StandardStream input = StandardStream::ours, output = StandardStream::ours, errors = StandardStream::ours;
    std::vector<std::pair<std::string, std::string>> environment = {};  ///< set besides ours, or in its place
    bool ends_with_us = false;  ///< gets SIGTERM when the thread that started it ends, in whatever way
};

/// A program in a process of its own. It is started without a shell and has of our files only the three
/// standard streams. It leads a process group: Ctrl-C reaches us alone, and what it has started itself can be
/// told to stop with it. Nobody is left behind: a program that still runs when this goes is killed with its
/// group.
class Process {
  public:
    /// @param words the program, looked for on the PATH unless it has a slash, and what it is told
    /// @throws std::system_error that names a program which cannot be started
    explicit Process(const std::vector<std::string>& words, const ProcessOptions& options = {});
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Writes all of it into the program's input; where nobody reads that any more, an error and no SIGPIPE.
    std::error_code write(std::string_view bytes);
    void closeInput() { input_.reset(); }
    /// Whatever has come of the program's output; waits for something. @returns nothing at its end
    std::optional<std::string> read();
    /// To poll; -1 where they are no pipes.
    int output() const { return output_.get(); }
    int errors() const { return errors_.get(); }

    /// Sends a signal to the program and its group.
    void tell(int signal) const;
    /// Closes its input and waits for its end, once; after that, tells it again.
    ProgramEnd wait();

  private:
    pid_t id_ = -1;  ///< -1 once it has been waited for
    ProgramEnd end_;
    Descriptor input_, output_, errors_;
};

/// What a program said, and how it ended.
struct ProgramRun {
    ProgramEnd end;
    std::string output, errors;
};

/// Runs a program to its end. @throws std::system_error that names a program which cannot be started
ProgramRun runProgram(const std::vector<std::string>& words);

}  // namespace throng
