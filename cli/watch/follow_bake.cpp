// SPDX-License-Identifier: Apache-2.0
#include "cli/watch/follow_bake.h"

#include <chrono>
#include <optional>
#include <thread>

#include "analysis/live/moments.h"
#include "base/stopwatch.h"
#include "io/growing_bake.h"

namespace throng::cli {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{100};
constexpr double kBetweenWords = 0.5;  // s

/// A bake as it was opened, and how much of it has been shown.
class Shown {
  public:
    /// @param before whose place it takes, or null
    Shown(const fs::path& path, double per_second, LiveLog& log, const Shown* before)
        : growing_(path), packer_(growing_.bake(), per_second), log_(log) {
        nlohmann::ordered_json about = packer_.about(growing_.people(), !growing_.bake().vehicles.empty());
        const auto inputs = [](const Shown& shown) {
            return shown.growing_.bake().manifest.value("inputs", "");
        };
        about["continues"] = before && inputs(*before) == inputs(*this);
        log_.begin(about);
    }

    /// Shows what has come. @returns whether there may be more
    bool goOn(const std::function<bool()>& stop) {
        const std::uint32_t there = growing_.frames();
        if (there > next_) grew_ = Clock::now();
        for (; next_ < there && !full_ && !stop(); ++next_)
            if (packer_.wants(next_)) show(next_);
        tell();
        return !full_ && (growing_.isUnderWay() || next_ < there);
    }
    bool isUnderWay() const { return growing_.isUnderWay(); }
    bool isOver() const { return growing_.isOver(); }

  private:
    void show(std::uint32_t frame) {
        growing_.readFrame(frame, places_, states_);
        growing_.readVehicles(frame, vehicles_);
        full_ = !log_.add(packer_.pack(frame, places_, states_, vehicles_));
    }

    void tell() {
        const bool done = full_ || !growing_.isUnderWay();
        if (!done && secondsSince(told_) < kBetweenWords) return;
        told_ = Clock::now();
        log_.tell({{"state", full_                      ? "full"
                             : growing_.isUnderWay()    ? "baking"
                             : growing_.bake().complete ? "baked"
                                                        : "partial"},
                   {"frame", next_},
                   {"frames", growing_.bake().frames},
                   {"silent_seconds", growing_.isUnderWay() ? secondsSince(grew_) : 0.0}});
    }

    io::GrowingBake growing_;
    analysis::MomentPacker packer_;
    LiveLog& log_;
    std::vector<float> places_, states_, vehicles_;
    std::uint32_t next_ = 0;
    bool full_ = false;
    Clock::time_point told_{}, grew_ = Clock::now();
};

/// What a folder in which a bake is written will be called.
fs::path finalPath(const fs::path& path) {
    const std::string ending = path.extension().string();
    return ending == ".unfinished" || ending.starts_with(".tmp-") ? fs::path(path).replace_extension() : path;
}

/// The bake that has taken the place of one, if there is one yet.
std::unique_ptr<Shown> openAgain(const fs::path& path, double per_second, LiveLog& log,
                                 const Shown& before) try {
    return std::make_unique<Shown>(path, per_second, log, &before);
} catch (const InputError&) {
    return nullptr;
}

}  // namespace

void followBake(const fs::path& path, double per_second, LiveLog& log, const std::function<bool()>& stop) {
    auto shown = std::make_unique<Shown>(path, per_second, log, nullptr);
    bool goes_on = true;
    while (!stop()) {
        // Asked before what is there is read: at its end, a bake is closed after its last frame.
        const bool over = shown->isOver();
        try {
            if (goes_on) goes_on = shown->goOn(stop);
        } catch (const InputError&) {
            if (!over && !shown->isOver()) throw;
        }
        if (over) {
            if (auto next = openAgain(finalPath(path), per_second, log, *shown)) {
                shown = std::move(next);
                goes_on = true;
                continue;
            }
            log.tell({{"state", "gone"}});
        }
        std::this_thread::sleep_for(kBetweenLooks);
    }
}

}  // namespace throng::cli
