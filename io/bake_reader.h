// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "authoring/layout.h"
#include "base/door_track.h"
#include "base/files/errors.h"
#include "base/lift_track.h"
#include "base/vehicle_track.h"
#include "io/streams/stream_format.h"
#include "recording/bake_description.h"

namespace throng::io {

/// What a bake's manifest says. Lengths in metres; geometry and bounds relative to `origin`.
struct Bake {
    std::filesystem::path folder;
    nlohmann::ordered_json manifest;  ///< all of bake.json

    std::string name;
    bool complete = false;
    double fps = 24.0;
    std::uint32_t frames = 0;
    std::uint32_t agents = 0;
    std::uint64_t seed = 0;
    glm::dvec2 origin{0.0};
    glm::dvec2 minimum{0.0};
    glm::dvec2 maximum{0.0};
    std::vector<authoring::Road> roads;
    std::vector<authoring::Area> areas;
    std::vector<authoring::Patch> patches;
    std::vector<authoring::Wall> walls;
    authoring::Traffic traffic;  ///< lanes, crossings and signals
    std::vector<VehicleIdentity> vehicles;
    std::vector<DoorIdentity> doors;  ///< per vehicle; empty: there is no such file
    std::vector<LiftIdentity> lifts;
    std::vector<recording::BakeSeats> seats;
    bool has_poses = false;
    /// Floors above each other, if there are any; then also the lowest and highest ground along each wall, m.
    std::vector<authoring::Level> levels;
    std::vector<authoring::Link> links;
    std::vector<glm::dvec2> wall_ground;
    bool hasStoreys() const { return !levels.empty(); }
    bool has_grounds = false;  ///< levels are a terrain's: their floors are outlines, and not level

    struct Account {
        std::uint32_t agents = 0;
        std::uint32_t spawned = 0;
        std::uint32_t walking = 0;
        std::uint32_t arrived = 0;
        std::uint32_t refused = 0;
    } account;

    struct File {
        std::string path;  ///< relative to the folder; never leads out of it
        std::uint64_t bytes = 0;
        std::string xxh3;
    };
    std::vector<File> files;

    StreamChoice streams;   ///< that it says it has
    StreamFormats formats;  ///< in which it says it has all of them
    std::filesystem::path streamPath(Stream stream, StreamFormat format) const {
        return folder / streamFile(infoOf(stream), format);
    }
    /// Of the form that is read.
    std::filesystem::path streamPath(Stream stream) const { return streamPath(stream, formats.preferred()); }
};

/// bake.json as it lies on the disk.
struct ManifestFile {
    std::filesystem::path path;
    std::string text;
    nlohmann::ordered_json json;
};

/// Reads it: `path` is the folder or its bake.json. Throws InputError where it is no manifest of a bake.
ManifestFile readManifest(const std::filesystem::path& path);

/// Reads the manifest of a bake: `path` is the folder or its bake.json. Throws InputError, which says what is
/// missing or wrong; reads no other file.
Bake loadBake(const std::filesystem::path& path);
/// The same of a manifest that has been read, or was never written.
Bake bakeOf(ManifestFile file);

}  // namespace throng::io
