// SPDX-License-Identifier: Apache-2.0
#include "io/bake_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <utility>

#include "base/activities.h"
#include "base/files/output_file.h"
#include "io/diagram/diagram_exr.h"
#include "io/door_file.h"
#include "io/lift_file.h"
#include "io/room_on_disk.h"
#include "io/under_way.h"
#include "io/vehicle_file.h"
#include "recording/gaits.h"

namespace throng::io {
namespace {

constexpr const char* kFirstAlive = "first alive";
constexpr const char* kDiagrams = "diagrams";
constexpr const char* kDiagramHashes = "diagram hashes";
constexpr double kFreeWalk = 1.34;  // m/s
constexpr const char* kGaitsWalked = "gaits walked";

/// A file as a checkpoint remembers it.
struct KnownFile {
    std::uint64_t bytes = 0;
    char xxh3[16] = {};
};

std::string streamSection(const StreamInfo& info) {
    return fmt::format("hash of {}", info.name);
}

std::string packedSection(const StreamInfo& info) {
    return fmt::format("packed {}", info.name);
}

std::span<const std::byte> packedStateIn(const Checkpoint& checkpoint, const StreamInfo& info) {
    const std::vector<std::byte>* bytes = checkpoint.find(packedSection(info));
    if (!bytes)
        throw std::runtime_error(
            fmt::format("the checkpoint says nothing of the packed stream `{}`", info.name));
    return *bytes;
}

template <class T>
void readSection(const Checkpoint& checkpoint, const char* name, std::span<T> items) {
    const std::vector<std::byte>* bytes = checkpoint.find(name);
    if (!bytes || bytes->size() != items.size_bytes())
        throw std::runtime_error(fmt::format("the checkpoint's part `{}` does not fit this bake", name));
    std::copy(bytes->begin(), bytes->end(), std::as_writable_bytes(items).begin());
}

/// How many diagrams had been written: perhaps of later frames than the streams have.
std::uint32_t diagramsIn(const Checkpoint& checkpoint) {
    if (!checkpoint.find(kDiagrams)) return 0;
    DiagramSummary summary;
    readSection(checkpoint, kDiagrams, std::span(&summary, 1));
    return summary.count;
}

/// A checkpoint may say anything, and its frames and images are counted on.
void checkCounts(const Checkpoint& checkpoint, const recording::BakeDescription& description) {
    const std::uint32_t every = description.diagram_every, frames = description.frames;
    const std::uint32_t most_diagrams = every > 0 && frames > 0 ? (frames - 1) / every + 1 : 0;
    if (checkpoint.frames > frames || diagramsIn(checkpoint) > most_diagrams)
        throw std::runtime_error("the checkpoint has more frames or images than this bake");
}

std::uint64_t streamHashIn(const Checkpoint& checkpoint, const StreamInfo& info) {
    std::uint64_t hash = 0;
    readSection(checkpoint, streamSection(info).c_str(), std::span(&hash, 1));
    return hash;
}

}  // namespace

BakeWriter::BakeWriter(const recording::BakeDescription& description)
    : BakeWriter(description, std::make_unique<BakeFolder>(description.output, description.force), nullptr) {}

BakeWriter::BakeWriter(const recording::BakeDescription& description, const Checkpoint* go_on_from)
    : BakeWriter(
          description,
          std::make_unique<BakeFolder>(description.output, description.force,
                                       go_on_from ? BakeFolder::Begun::go_on : BakeFolder::Begun::begin),
          go_on_from) {}

BakeWriter::BakeWriter(recording::BakeDescription description, std::unique_ptr<BakeFolder> folder,
                       const Checkpoint* go_on_from)
    : description_(std::move(description)),
      folder_(std::move(folder)),
      first_alive_(description_.agents.size(), kNone),
      placed_(description_.agents.size() * kComponents) {
    if (go_on_from)
        removeLeftovers(*go_on_from);
    else
        folder_->addFolder("streams");
    requireRoom(folder_->path(), countOf(description_.streams()), description_.formats,
                description_.frames - (go_on_from ? go_on_from->frames : 0), description_.agents.size());
    openStreams(go_on_from);
    if (go_on_from)
        goOnFrom(*go_on_from);
    else if (description_.diagram_every > 0)
        folder_->addFolder("diagrams");
    if (!description_.vehicles.empty())
        shown_vehicles_.emplace(
            folder_->path() / kVehicleFile,
            TrackShape{description_.frames, description_.vehicles.size(), kVehicleFloats});
    replaceFile(folder_->path() / kUnderWayFile, underWayText(description_));  // nobody may see half of it
}

void BakeWriter::showVehicles(std::span<const float> track) {
    if (!shown_vehicles_) return;
    const std::size_t values = description_.vehicles.size() * kVehicleFloats;
    const std::span<const float> news = track.subspan(shown_vehicles_->framesWritten() * values);
    shown_vehicles_->add(
        placedVehicles(description_, news, static_cast<std::uint32_t>(news.size() / values)));
}

/// Those that were asked for come last, as bake.json has always listed their files.
/// @param go_on_from may be before the first frame: the recorded motion lags behind
void BakeWriter::openStreams(const Checkpoint* go_on_from) {
    const bool is_packed = description_.formats.has(StreamFormat::packed);
    const StreamChoice streams = description_.streams();
    for (const bool asked : {false, true})
        for (const StreamInfo& info : kStreams) {
            if (!streams[info.id] || isAskedFor(info) != asked) continue;
            std::optional<StreamSoFar> so_far;
            if (go_on_from) so_far = {go_on_from->frames, {}};
            if (go_on_from && is_packed) so_far->packed = packedStateIn(*go_on_from, info);
            streams_.emplace_back(folder_->path(), info, description_.formats,
                                  static_cast<std::uint32_t>(description_.agents.size()), description_.frames,
                                  so_far);
            hashes_.emplace_back();
        }
}

/// What an earlier run wrote after its last checkpoint, or while it was finishing the bake.
void BakeWriter::removeLeftovers(const Checkpoint& checkpoint) const {
    namespace fs = std::filesystem;
    checkCounts(checkpoint, description_);  // before anything goes
    std::vector<fs::path> leftovers;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_->path()))
        if (!entry.is_directory() && !isCheckpoint(entry.path())) leftovers.push_back(entry.path());
    for (std::uint32_t frame = 0, kept = diagramsIn(checkpoint);
         description_.diagram_every > 0 && frame < description_.frames; frame += description_.diagram_every)
        if (frame >= kept * description_.diagram_every)
            for (const std::string& name : diagramNames(frame))
                leftovers.push_back(folder_->path() / name);
    for (const fs::path& path : leftovers)
        removeFile(path);
}

std::vector<std::string> BakeWriter::diagramNames(std::uint32_t frame) const {
    std::vector<std::string> names{fmt::format("diagrams/diagram.{:04}.exr", frame + 1)};
    if (description_.charts) names.push_back(fmt::format("diagrams/storeys.{:04}.exr", frame + 1));
    return names;
}

void BakeWriter::goOnFrom(const Checkpoint& checkpoint) {
    frames_ = checkpoint.frames;
    readSection(checkpoint, kFirstAlive, std::span(first_alive_));
    readSection(checkpoint, kGaitsWalked, std::span(&gaits_, 1));
    for (std::size_t i = 0; i < streams_.size(); ++i)
        hashAgain(i, streamHashIn(checkpoint, streams_[i].info()));
    if (diagramsIn(checkpoint) == 0) return;
    diagrams_.emplace();
    readSection(checkpoint, kDiagrams, std::span(&*diagrams_, 1));
    goOnWithDiagrams(checkpoint);
}

/// Of the frames that are there already, in every exact form; a packed file has been compared already.
/// @param then what it was at the checkpoint
void BakeWriter::hashAgain(std::size_t stream, std::uint64_t then) {
    std::vector<float> values(description_.agents.size() * kComponents);
    for (const StreamWriter& writer : streams_[stream].writers()) {
        EnteredHash& hash = hashes_[stream] = EnteredHash();
        for (std::uint32_t frame = 0; frame < frames_; ++frame) {
            writer.readBack(frame, values);
            hash.add(frame, values, first_alive_);
        }
        if (hash.digest() != then) throw InputError(writer.path(), kDoesNotFitCheckpoint);
    }
}

void BakeWriter::goOnWithDiagrams(const Checkpoint& checkpoint) {
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < diagrams_->count; ++i)
        for (std::string& name : diagramNames(i * description_.diagram_every))
            names.push_back(std::move(name));
    std::vector<KnownFile> known(names.size());
    readSection(checkpoint, kDiagramHashes, std::span(known));
    for (std::size_t i = 0; i < names.size(); ++i) {
        const FileHash then{known[i].bytes, {std::begin(known[i].xxh3), std::end(known[i].xxh3)}};
        if (hashFile(folder_->path() / names[i]) != then)
            throw InputError(folder_->path() / names[i], kDoesNotFitCheckpoint);
        diagram_files_.push_back({names[i], then});
    }
}

/// Of what has been written so far: a later run compares it with what it finds.
void BakeWriter::addHashes(Checkpoint& checkpoint) const {
    for (std::size_t i = 0; i < streams_.size(); ++i) {
        const std::uint64_t hash = hashes_[i].digest();
        checkpoint.add(streamSection(streams_[i].info()), std::as_bytes(std::span(&hash, 1)));
    }
    std::vector<KnownFile> known;
    for (const BakeOutcome::File& file : diagram_files_) {
        known.push_back({file.hash.bytes, {}});
        file.hash.xxh3.copy(known.back().xxh3, sizeof known.back().xxh3);
    }
    if (!known.empty()) checkpoint.add(kDiagramHashes, std::as_bytes(std::span(known)));
}

void BakeWriter::save(Checkpoint checkpoint) {
    for (StreamFiles& stream : streams_)
        stream.flush();
    checkpoint.frames = frames_;
    checkpoint.add(kFirstAlive, std::as_bytes(std::span(first_alive_)));
    checkpoint.add(kGaitsWalked, std::as_bytes(std::span(&gaits_, 1)));
    if (diagrams_) checkpoint.add(kDiagrams, std::as_bytes(std::span(&*diagrams_, 1)));
    for (StreamFiles& stream : streams_)
        if (const auto state = stream.packedState()) checkpoint.add(packedSection(stream.info()), *state);
    addHashes(checkpoint);
    saveCheckpoint(folder_->path(), checkpoint);
    folder_->keep();
}

void BakeWriter::write(const Frame& frame) {
    if (frame.index != frames_) throw std::invalid_argument("frames come in order");
    for (const StreamFiles& stream : streams_)
        if (frame[stream.info().id].size() != description_.agents.size() * kComponents)
            throw std::invalid_argument(fmt::format(
                "a frame of this bake has three values for each person in `{}`", stream.info().name));
    trackPeople(frame);
    for (std::size_t i = 0; i < streams_.size(); ++i) {
        const StreamInfo& info = streams_[i].info();
        const std::span<const float> values =
            info.in_plane == InPlane::place ? placed(frame[info.id]) : frame[info.id];
        streams_[i].append(values, first_alive_);
        if (!streams_[i].writers().empty()) hashes_[i].add(frame.index, values, first_alive_);
    }
    ++frames_;
}

/// Places in the output frame of reference.
std::span<const float> BakeWriter::placed(std::span<const float> places) {
    std::ranges::copy(places, placed_.begin());
    description_.toOutput(placed_);
    return placed_;
}

/// Kept here rather than taken from the account, so that what is filled in always agrees with the alive
/// flags.
void BakeWriter::trackPeople(const Frame& frame) {
    for (std::size_t row = 0; row < first_alive_.size(); ++row) {
        const float activity = frame[Stream::state][row * kComponents];
        if (activity <= 0.5f) continue;
        if (first_alive_[row] == kNone) first_alive_[row] = frame.index;
        if (!hasPose(activity)) gaits_ |= 1u << recording::gaitOf(activity);
    }
}

void BakeWriter::writeDiagram(const Frame& frame) {
    if (!frame.diagram || description_.diagram_every == 0 || frame.index % description_.diagram_every != 0)
        return;
    const DiagramImage& image = *frame.diagram;
    const std::vector<std::string> names = diagramNames(frame.index);
    writeDiagramExr(folder_->path() / names[0], image, frame[Stream::density], description_.scene_origin,
                    frame.index, description_.fps);
    if (description_.charts) writeChartsExr(folder_->path() / names[1], image, frame, description_);
    for (const std::string& name : names)
        diagram_files_.push_back({name, hashFile(folder_->path() / name)});
    if (!diagrams_) {
        const glm::dvec2 minimum =
            description_.scene_origin + glm::dvec2(image.minimum) - description_.output_origin;
        diagrams_ = DiagramSummary{0, image.width, image.height, image.pixels_per_metre, minimum};
    }
    ++diagrams_->count;
}

BakeOutcome BakeWriter::writeAll(const Account& account, const BakeTiming& timing, bool complete) {
    BakeOutcome outcome;
    outcome.complete = complete;
    outcome.frames = frames_;
    outcome.account = countOutcomes(account);
    outcome.timing = timing;
    outcome.gaits = gaits_;
    // Where everybody sits: figures are made of walks, too.
    if (gaits_ == 0 && !description_.seats.empty()) outcome.gaits = 1u << recording::gaitFor(kFreeWalk);
    outcome.diagrams = diagrams_;
    std::vector<std::string> files{"layout.json", "agents.csv"};
    writeFile(folder_->path() / files[0], description_.layout_text);
    writeFile(folder_->path() / files[1], agentTable(description_, account));
    for (StreamFiles& stream : streams_) {
        stream.backFill(first_alive_);
        stream.finish();
    }
    for (const std::string& file : filesOf(streams_))
        files.push_back(file);
    if (description_.terrain) {
        files.push_back("terrain.glb");
        writeTerrainGlb(folder_->path() / files.back(), description_);
    }
    const std::vector<float> vehicles = placedVehicles(description_, vehicle_track_, frames_);
    if (!description_.vehicles.empty()) {
        files.push_back(kVehicleFile);
        shown_vehicles_.reset();
        removeFile(folder_->path() / kVehicleFile);  // there may be fewer frames than were expected
        writeVehicles(folder_->path() / files.back(), vehicles, frames_, description_.vehicles.size());
    }
    door_track_.resize(frames_ * description_.doors.size() * kDoorFloats);
    if (!description_.doors.empty()) {
        files.push_back(kDoorFile);
        writeDoors(folder_->path() / files.back(), door_track_, frames_, description_.doors.size());
    }
    if (!description_.lifts.empty()) {
        files.push_back(kLiftFile);
        writeLifts(folder_->path() / files.back(), lift_track_, frames_, description_.lifts.size());
    }
    if (description_.gltf) {
        files.push_back("crowd.glb");
        outcome.gltf = writeCrowdGlb(folder_->path() / files.back(), description_,
                                     {folder_->path(), description_.streams(), description_.formats, frames_,
                                      static_cast<std::uint32_t>(description_.agents.size())},
                                     {{vehicles, door_track_}, {liftsOf(description_), lift_track_}});
    }
    for (const std::string& file : files)
        outcome.files.push_back({file, hashFile(folder_->path() / file)});
    outcome.files.insert(outcome.files.end(), diagram_files_.begin(), diagram_files_.end());
    removeFile(folder_->path() / kUnderWayFile);
    writeFile(folder_->path() / "bake.json", manifestText(bakeManifest(description_, outcome)));
    return outcome;
}

BakeResult BakeWriter::resultAt(std::filesystem::path path, const BakeOutcome& outcome) const {
    return {std::move(path), outcome.frames, outcome.account, outcome.gltf, diagrams_ ? diagrams_->count : 0};
}

/// Only once the bake has its name: who is stopped before that goes on from them.
void BakeWriter::tidy(const std::filesystem::path& bake) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(bake))
        if (isCheckpoint(entry.path())) found.push_back(entry.path());
    for (const std::filesystem::path& path : found)
        removeFile(path);
}

BakeResult BakeWriter::finish(const Account& account, const BakeTiming& timing) {
    if (frames_ > description_.frames || (frames_ < description_.frames && !description_.ends_when_empty))
        throw std::logic_error("frames are missing: only finishPartial() can be used");
    const BakeOutcome outcome = writeAll(account, timing, true);
    BakeResult result = resultAt(folder_->commit(), outcome);
    tidy(result.path);
    return result;
}

BakeResult BakeWriter::finishPartial(const Account& account, const BakeTiming& timing) {
    const BakeOutcome outcome = writeAll(account, timing, false);
    BakeResult result = resultAt(folder_->commitPartial(), outcome);
    tidy(result.path);
    return result;
}

}  // namespace throng::io
