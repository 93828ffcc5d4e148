// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace throng::gl {

/// What a buffer or a drawn picture holds.
struct Contents {
    std::string name;
    std::string per;                ///< what it has an element for: "person", "cell"; empty: it is one thing
    std::size_t element_bytes = 0;  ///< of one element
};

/// What one command for the device does with one buffer.
struct Touch {
    std::shared_ptr<const Contents> contents;
    bool reads = false;
    bool writes = false;

    bool operator==(const Touch&) const = default;
};

/// One command: a program's launch, or a transfer.
struct Command {
    std::string pass;      ///< the one under way
    std::string declared;  ///< the one that the program says it belongs to; empty: a transfer
    std::string what;      ///< the program's shaders, or "fill", "copy", "upload", "download"
    std::vector<Touch> touches;
};

/// Keeps what this thread asks of the device, in order, for as long as it lives: for tables and tests. At
/// most one is kept at a time.
class Journal {
  public:
    /// What is kept beside the commands.
    enum class Times {
        none,
        of_device,  ///< the device's clock is read before each command; nothing waits
        of_wall,    ///< each command is waited for: software renderers have no clock of their own
    };

    explicit Journal(Times times = Times::none);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Commands that follow belong to this pass.
    void beginPass(const std::string& pass) { pass_ = pass; }
    const std::vector<Command>& commands() const { return commands_; }
    /// Waits for the device. @returns ms that each command took, until the next one began; needs Times
    std::vector<double> milliseconds();

    /// The one that is being kept, or null.
    static Journal* kept();
    void note(const std::string& what, std::vector<Touch> touches, const std::string& declared = "");
    /// One more for the last command.
    void noteAlso(const Touch& touch);

  private:
    void readClock();

    Times times_;
    std::string pass_;
    std::vector<Command> commands_;
    std::vector<std::uint32_t> queries_;  ///< of the device's clock, one a command
    std::vector<double> wall_;            ///< ms, one a command
};

}  // namespace throng::gl
