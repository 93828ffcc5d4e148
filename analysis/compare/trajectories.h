// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/crowd_reader.h"

namespace throng::analysis {

/// Where somebody was at even moments, one after the other without a gap.
struct Track {
    std::int64_t first = 0;          ///< the moment of the first place, in moments
    std::vector<glm::dvec2> places;  ///< m
};

/// People's ways, from a bake or as they were measured. Somebody who left and came back has several tracks.
struct Trajectories {
    std::string name;
    double rate = 0.0;  ///< moments in a second
    std::size_t people = 0;
    std::vector<Track> tracks;
};

/// How to understand a file of trajectories that does not say so itself.
struct TrajectoryOptions {
    std::optional<double> rate;    ///< frames in a second
    std::optional<double> metres;  ///< that its unit of length is
    glm::dvec2 move{0.0};          ///< m, after turning
    double turn = 0.0;             ///< rad, round the file's origin
};

/// Reads a file of trajectories: text as the archive of Forschungszentrum Juelich has it (person, frame, x,
/// y), CSV whose first line names its columns, a database of JuPedSim, or another bake. Throws InputError,
/// with line and column.
Trajectories readTrajectories(const std::filesystem::path& path, const TrajectoryOptions& options);

/// What the two kinds of files hold; used by readTrajectories().
Trajectories readTrajectoryText(const std::filesystem::path& path, const TrajectoryOptions& options);
Trajectories readTrajectoryDatabase(const std::filesystem::path& path, const TrajectoryOptions& options);

/// The ways of a bake's people until they arrive, `rate` times a second, in the world.
Trajectories trajectoriesOf(io::CrowdReader& crowd, double rate);

/// The same at another rate: between two frames, people walk straight.
Trajectories resampled(const Trajectories& trajectories, double rate);

/// One row of a file of trajectories.
struct Sighting {
    std::int64_t person = 0, frame = 0;
    glm::dvec2 place{0.0};  ///< m
    std::size_t line = 0;   ///< of the file, from 1; 0 = not known
};

/// Tracks out of rows in any order. Throws InputError where somebody is in two places in one frame.
std::vector<Track> tracksOf(const std::filesystem::path& path, std::vector<Sighting> rows,
                            std::size_t& people);

}  // namespace throng::analysis
