// SPDX-License-Identifier: Apache-2.0
#include "analysis/compare/trajectories.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/files/input_file.h"

namespace throng::analysis {
namespace {

bool isDatabase(const std::filesystem::path& path) {
    constexpr std::string_view kMagic = "SQLite format 3";
    const InputFile file(path);
    std::array<std::byte, kMagic.size()> begin{};
    if (file.size() < begin.size()) return false;
    file.readAt(0, begin);
    return std::equal(begin.begin(), begin.end(), kMagic.begin(),
                      [](std::byte byte, char letter) { return static_cast<char>(byte) == letter; });
}

bool isBake(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_directory(path, ignored) || path.filename() == "bake.json";
}

void place(Trajectories& trajectories, const TrajectoryOptions& options) {
    const double cosine = std::cos(options.turn), sine = std::sin(options.turn);
    for (Track& track : trajectories.tracks)
        for (glm::dvec2& p : track.places)
            p = glm::dvec2(cosine * p.x - sine * p.y, sine * p.x + cosine * p.y) + options.move;
}

/// One person's places, frame by frame, as moments of another rate pass.
class Follower {
  public:
    Follower(double frames_in_a_moment, std::vector<Track>& tracks)
        : frames_in_a_moment_(frames_in_a_moment), tracks_(tracks) {}

    void see(std::int64_t frame, glm::dvec2 now) {
        const bool goes_on = last_frame_ && *last_frame_ == frame - 1;
        if (!goes_on) {
            finish();
            next_ =
                static_cast<std::int64_t>(std::ceil(static_cast<double>(frame) / frames_in_a_moment_ - 1e-9));
            track_.first = next_;
        }
        for (;; ++next_) {
            const double at = static_cast<double>(next_) * frames_in_a_moment_;  // frames
            if (at > static_cast<double>(frame) + 1e-9) break;
            const double share = std::clamp(at - static_cast<double>(frame - 1), 0.0, 1.0);
            track_.places.push_back(goes_on ? before_ + share * (now - before_) : now);
        }
        before_ = now;
        last_frame_ = frame;
    }
    void finish() {
        if (!track_.places.empty()) tracks_.push_back(std::move(track_));
        track_ = {};
        last_frame_.reset();
    }

  private:
    double frames_in_a_moment_;
    std::vector<Track>& tracks_;
    Track track_;
    std::optional<std::int64_t> last_frame_;
    std::int64_t next_ = 0;
    glm::dvec2 before_{0.0};
};

}  // namespace

std::vector<Track> tracksOf(const std::filesystem::path& path, std::vector<Sighting> rows,
                            std::size_t& people) {
    std::stable_sort(rows.begin(), rows.end(), [](const Sighting& a, const Sighting& b) {
        return a.person != b.person ? a.person < b.person : a.frame < b.frame;
    });
    std::vector<Track> tracks;
    people = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool is_known = i > 0 && rows[i].person == rows[i - 1].person;
        if (is_known && rows[i].frame == rows[i - 1].frame)
            throw InputError(path, fmt::format("{}person {} is in two places in frame {}",
                                               rows[i].line ? fmt::format("{}: ", rows[i].line) : "",
                                               rows[i].person, rows[i].frame));
        people += is_known ? 0 : 1;
        if (!is_known || rows[i].frame != rows[i - 1].frame + 1) tracks.push_back({rows[i].frame, {}});
        tracks.back().places.push_back(rows[i].place);
    }
    return tracks;
}

Trajectories readTrajectories(const std::filesystem::path& path, const TrajectoryOptions& options) {
    Trajectories found;
    if (isBake(path)) {
        io::CrowdReader crowd(io::loadBake(path));
        found = trajectoriesOf(crowd, crowd.bake().fps);
    } else {
        found = isDatabase(path) ? readTrajectoryDatabase(path, options) : readTrajectoryText(path, options);
        found.name = path.filename().string();
    }
    if (found.tracks.empty()) throw InputError(path, "has no people: there is nothing to compare with");
    place(found, options);
    return found;
}

Trajectories trajectoriesOf(io::CrowdReader& crowd, double rate) {
    const io::Bake& bake = crowd.bake();
    Trajectories result{bake.name, rate, 0, {}};
    const auto& rows = crowd.people();
    std::vector<Follower> followers(rows.size(), Follower(bake.fps / rate, result.tracks));
    std::vector<bool> seen(rows.size());
    for (std::uint32_t index = 0; index < bake.frames && !rows.empty(); ++index) {
        const io::CrowdFrame frame = crowd.frame(index);
        for (std::size_t row = 0; row < rows.size(); ++row) {
            if (!frame.isThere(row) || index > rows[row].arrival_frame) continue;
            followers[row].see(index, frame.place(row) + bake.origin);
            seen[row] = true;
        }
    }
    for (Follower& follower : followers)
        follower.finish();
    result.people = static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true));
    return result;
}

Trajectories resampled(const Trajectories& trajectories, double rate) {
    Trajectories result{trajectories.name, rate, trajectories.people, {}};
    for (const Track& track : trajectories.tracks) {
        Follower follower(trajectories.rate / rate, result.tracks);
        for (std::size_t i = 0; i < track.places.size(); ++i)
            follower.see(track.first + static_cast<std::int64_t>(i), track.places[i]);
        follower.finish();
    }
    return result;
}

}  // namespace throng::analysis
