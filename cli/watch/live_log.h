// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace throng::cli {

/// What there is to see, for all who look on: a crowd, its moments so far, and what is told of it. Of the
/// crowd before nothing is kept. Any thread may write, and any read.
///
/// Messages are four letters, the length of what follows (32 bits, little-endian), and that: `CROW` a crowd
/// begins (JSON), `MOMT` a moment of it (analysis::MomentPacker), `TELL` how it goes (JSON).
class LiveLog {
  public:
    using Message = std::shared_ptr<const std::string>;

    /// @param most_bytes of all moments of a crowd
    explicit LiveLog(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

    /// From here on it is about another crowd.
    void begin(const nlohmann::ordered_json& crowd);
    /// @returns false where there is no room: the moment is not kept
    bool add(const std::string& moment);
    /// Takes the place of what was told before.
    void tell(nlohmann::ordered_json how_it_goes);
    /// From here on, these members are in all that is told: who comes late has to know them, too.
    void note(nlohmann::ordered_json members);
    /// Nobody waits any more.
    void close();

    /// How far somebody has read.
    struct Place {
        std::uint64_t crowd = 0, told = 0;
        std::size_t next = 0;
    };
    struct News {
        std::vector<Message> messages;  ///< none: nothing came in time
        bool closed = false;
    };
    /// What has come since; waits for it. @param place moves on
    News read(Place& place, std::chrono::milliseconds patience) const;

  private:
    bool hasNews(const Place& place) const;

    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    std::uint64_t most_bytes_, bytes_ = 0;
    std::uint64_t crowd_ = 0, told_ = 0;  ///< count them
    std::vector<Message> messages_;       ///< the crowd's
    Message last_told_;
    nlohmann::ordered_json noted_;
    bool closed_ = false;
};

}  // namespace throng::cli
