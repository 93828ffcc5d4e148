// SPDX-License-Identifier: Apache-2.0
#include "io/growing_bake.h"

#include <algorithm>
#include <system_error>

#include "io/bake_folder.h"
#include "io/vehicle_file.h"

namespace throng::io {
namespace fs = std::filesystem;
namespace {

bool isWrittenIn(const fs::path& folder) {
    std::error_code ignored;
    return fs::is_regular_file(folder / kUnderWayFile, ignored);
}

/// Of all folders in which a bake of that name is being written, the one begun last.
std::optional<fs::path> writtenFolder(const fs::path& path) {
    if (isWrittenIn(path)) return path;
    const fs::path unfinished = BakeFolder::unfinishedPath(path);
    const fs::path parent = unfinished.has_parent_path() ? unfinished.parent_path() : fs::path(".");
    const std::string begins = unfinished.stem().string() + ".tmp-";
    std::vector<std::pair<fs::file_time_type, fs::path>> found;
    std::error_code error;
    for (fs::directory_iterator it(parent, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        if ((name == unfinished.filename() || name.starts_with(begins)) && isWrittenIn(it->path()))
            found.emplace_back(fs::last_write_time(it->path() / kUnderWayFile, error), it->path());
    }
    if (found.empty()) return std::nullopt;
    return std::ranges::max_element(found)->second;
}

}  // namespace

GrowingBake::GrowingBake(const fs::path& path)
    : path_(path.filename() == "bake.json" ? path.parent_path() : path), folder_(path_) {
    const auto openVehicles = [this] {
        const Bake& bake = expected_.bake;
        if (!bake.vehicles.empty())
            vehicles_.emplace(folder_ / kVehicleFile,
                              TrackShape{bake.frames, bake.vehicles.size(), kVehicleFloats});
    };
    if (!fs::exists(path_ / "bake.json"))
        if (const auto written = writtenFolder(path_)) {
            folder_ = *written;
            expected_ = readUnderWay(folder_);
            remember(kUnderWayFile);
            const Bake& bake = expected_.bake;
            const StreamFormat format = bake.formats.preferred();
            for (auto [stream, opened] :
                 {std::pair(Stream::pos, &places_), std::pair(Stream::state, &states_)})
                opened->emplace(bake.streamPath(stream), infoOf(stream), format, bake.frames, bake.agents);
            openVehicles();
            return;
        }
    remember("bake.json");
    complete_ = std::make_unique<CrowdReader>(loadBake(path_));
    expected_ = {complete_->bake(), complete_->people()};
    openVehicles();
}

std::uint32_t GrowingBake::frames() {
    if (complete_) return complete_->frames();
    const std::uint32_t vehicles = vehicles_ ? vehicles_->frames() : expected_.bake.frames;
    return std::min({places_->frames(), states_->frames(), vehicles, expected_.bake.frames});
}

void GrowingBake::readVehicles(std::uint32_t frame, std::vector<float>& vehicles) {
    vehicles.resize(expected_.bake.vehicles.size() * kVehicleFloats);
    if (vehicles_) vehicles_->readFrame(frame, vehicles);
}

void GrowingBake::readFrame(std::uint32_t frame, std::vector<float>& places, std::vector<float>& states) {
    const std::size_t values = std::size_t{expected_.bake.agents} * kComponents;
    places.resize(values);
    states.resize(values);
    if (!complete_) {
        places_->readFrame(frame, places);
        states_->readFrame(frame, states);
        return;
    }
    const CrowdFrame read = complete_->frame(frame);
    std::ranges::copy(read[Stream::pos], places.begin());
    std::ranges::copy(read[Stream::state], states.begin());
}

void GrowingBake::remember(const char* file) {
    std::error_code ignored;
    told_by_ = folder_ / file;
    told_at_ = fs::last_write_time(told_by_, ignored);
}

bool GrowingBake::isOver() const {
    std::error_code error;
    return fs::last_write_time(told_by_, error) != told_at_ || error;
}

}  // namespace throng::io
