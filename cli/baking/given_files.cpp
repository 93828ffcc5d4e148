// SPDX-License-Identifier: Apache-2.0
#include "cli/baking/given_files.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <span>

#include "analysis/compare/trajectories.h"
#include "authoring/layout/layout_reader.h"
#include "base/files/errors.h"
#include "base/files/hash.h"

namespace throng::cli {
namespace {

using authoring::GivenPeople;
using authoring::GivenPoint;

std::vector<GivenPoint> wayOf(const analysis::Track& track, double rate, const GivenPeople& given) {
    std::vector<GivenPoint> way;
    for (std::size_t i = 0; i < track.places.size(); ++i)
        way.push_back({static_cast<double>(track.first + static_cast<std::int64_t>(i)) / rate + given.start,
                       track.places[i] + given.offset,
                       {}});
    return way;
}

/// Who is seen once only goes no way. @returns how many of these are left out
std::size_t readGivenFile(const std::filesystem::path& path, GivenPeople& given) {
    analysis::TrajectoryOptions options;
    options.rate = given.fps;
    const analysis::Trajectories found = analysis::readTrajectories(path, options);
    std::size_t alone = 0;
    for (const analysis::Track& track : found.tracks)
        if (track.places.size() > 1)
            given.ways.push_back(wayOf(track, found.rate, given));
        else
            ++alone;
    return alone;
}

void tellOfMany(const authoring::Layout& layout, authoring::Diagnostics& diagnostics) {
    const double most = authoring::layoutRules().definition("flow").property("count").limits().most;
    double people = 0.0;
    for (const GivenPeople& given : layout.given) {
        people += static_cast<double>(given.ways.size());
        if (people <= most) continue;
        return diagnostics.error(given.file_where,
                                 fmt::format("{:.0f} given people are more than the {:.0f} that one bake can "
                                             "hold",
                                             people, most));
    }
}

}  // namespace

std::uint64_t readGivenFiles(const std::string& name, authoring::Layout& layout,
                             authoring::Diagnostics& diagnostics) {
    Hasher hasher;
    bool any = false;
    for (GivenPeople& given : layout.given) {
        if (given.file.empty()) continue;
        any = true;
        try {
            const std::size_t alone =
                readGivenFile(std::filesystem::path(name).parent_path() / given.file, given);
            if (alone > 0)
                diagnostics.warning(given.file_where,
                                    fmt::format("{} of the people in `{}` are seen once only, and left out",
                                                alone, given.file));
            if (given.ways.empty())
                diagnostics.error(given.file_where, fmt::format("nobody in `{}` goes any way", given.file));
        } catch (const InputError& error) {
            diagnostics.error(given.file_where,
                              fmt::format("the trajectories cannot be used: {}", error.what()),
                              "`file` is relative to the layout's folder; files that do not tell their frame "
                              "rate need `fps`");
        }
        for (const std::vector<GivenPoint>& way : given.ways) {
            const std::size_t points = way.size();
            hasher.add(std::as_bytes(std::span(&points, 1)));
            for (const GivenPoint& point : way) {
                const std::array<double, 3> told = {point.time, point.place.x, point.place.y};
                hasher.add(std::as_bytes(std::span(told)));
            }
        }
    }
    if (any) tellOfMany(layout, diagnostics);
    return any ? hasher.digest() : 0;
}

}  // namespace throng::cli
