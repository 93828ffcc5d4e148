// SPDX-License-Identifier: Apache-2.0
#include "io/bake_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <utility>

#include "base/files/output_file.h"
#include "io/diagram/diagram_exr.h"
#include "recording/gaits.h"

namespace throng::io {
namespace {

// What rows hold before they enter (docs/bake.md): where they will appear, facing as they will, standing
// still, not alive, with the gait phase they will start from.
constexpr std::array kPositionRule{BackFill::first_alive, BackFill::first_alive, BackFill::first_alive};
constexpr std::array kDirectionRule{BackFill::first_alive, BackFill::first_alive, BackFill::zero};
constexpr std::array kGroundRule{BackFill::first_alive, BackFill::first_alive, BackFill::first_alive};
constexpr std::array kDensityRule{BackFill::keep, BackFill::keep, BackFill::keep};
constexpr std::array kStateRule{BackFill::keep, BackFill::first_alive, BackFill::first_alive};

StreamWriter openStream(const std::filesystem::path& path, StreamFormat format,
                        const recording::BakeDescription& description,
                        std::optional<std::uint32_t> frames_there) {
    const auto rows = static_cast<std::uint32_t>(description.agents.size());
    return frames_there ? StreamWriter(path, format, rows, description.frames, *frames_there)
                        : StreamWriter(path, format, rows, description.frames);
}

/// How many frames the streams have, perhaps none yet (the recorded motion lags behind), where a bake goes
/// on.
std::optional<std::uint32_t> framesIn(const Checkpoint* go_on_from) {
    return go_on_from ? std::optional(go_on_from->frames) : std::nullopt;
}

}  // namespace

BakeWriter::Stream::Stream(const std::filesystem::path& folder, const std::string& stream_name,
                           const recording::BakeDescription& description,
                           std::optional<std::uint32_t> frames_there)
    : name(stream_name),
      npy(openStream(folder / (stream_name + ".npy"), StreamFormat::npy, description, frames_there)),
      pc2(openStream(folder / (stream_name + ".pc2"), StreamFormat::pc2, description, frames_there)) {}

void BakeWriter::Stream::append(std::span<const float> frame) {
    npy.append(frame);
    pc2.append(frame);
}

void BakeWriter::Stream::finish(std::span<const std::uint32_t> first_alive,
                                const std::array<BackFill, kComponents>& rule) {
    for (StreamWriter* writer : {&npy, &pc2}) {
        writer->backFill(first_alive, rule);
        writer->finish();
    }
}

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
      streams_folder_(streamsFolder(go_on_from)),
      positions_(streams_folder_, "pos", description_, framesIn(go_on_from)),
      directions_(streams_folder_, "dir", description_, framesIn(go_on_from)),
      states_(streams_folder_, "state", description_, framesIn(go_on_from)),
      first_alive_(description_.agents.size(), kNone),
      shifted_(description_.agents.size() * kComponents) {
    if (description_.densities)
        densities_.emplace(streams_folder_, "density", description_, framesIn(go_on_from));
    if (description_.terrain) grounds_.emplace(streams_folder_, "ground", description_, framesIn(go_on_from));
    if (go_on_from)
        goOnFrom(*go_on_from);
    else if (description_.diagram_every > 0)
        folder_->addFolder("diagrams");
}

std::filesystem::path BakeWriter::streamsFolder(const Checkpoint* go_on_from) {
    if (!go_on_from) return folder_->addFolder("streams");
    removeLeftovers(*go_on_from);
    return folder_->path() / "streams";
}

namespace {

constexpr const char* kFirstAlive = "first alive";
constexpr const char* kDiagrams = "diagrams";
constexpr const char* kGaitsWalked = "gaits walked";

std::string diagramName(std::uint32_t frame) {
    return fmt::format("diagrams/diagram.{:04}.exr", frame + 1);
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

}  // namespace

/// What an earlier run wrote after its last checkpoint, or while it was finishing the bake.
void BakeWriter::removeLeftovers(const Checkpoint& checkpoint) const {
    namespace fs = std::filesystem;
    std::vector<fs::path> leftovers;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_->path()))
        if (!entry.is_directory() && !isCheckpoint(entry.path())) leftovers.push_back(entry.path());
    for (std::uint32_t frame = 0, kept = diagramsIn(checkpoint);
         description_.diagram_every > 0 && frame < description_.frames; frame += description_.diagram_every)
        if (frame >= kept * description_.diagram_every)
            leftovers.push_back(folder_->path() / diagramName(frame));
    for (const fs::path& path : leftovers)
        fs::remove(path);
}

void BakeWriter::goOnFrom(const Checkpoint& checkpoint) {
    frames_ = checkpoint.frames;
    readSection(checkpoint, kFirstAlive, std::span(first_alive_));
    readSection(checkpoint, kGaitsWalked, std::span(&gaits_, 1));
    if (diagramsIn(checkpoint) == 0) return;
    diagrams_.emplace();
    readSection(checkpoint, kDiagrams, std::span(&*diagrams_, 1));
    for (std::uint32_t i = 0; i < diagrams_->count; ++i)
        diagram_files_.push_back(diagramName(i * description_.diagram_every));
}

std::vector<BakeWriter::Stream*> BakeWriter::streams() {
    std::vector<Stream*> all = {&positions_, &directions_, &states_};
    if (grounds_) all.push_back(&*grounds_);
    if (densities_) all.push_back(&*densities_);
    return all;
}

void BakeWriter::save(Checkpoint checkpoint) {
    for (Stream* stream : streams()) {
        stream->npy.flush();
        stream->pc2.flush();
    }
    checkpoint.frames = frames_;
    checkpoint.add(kFirstAlive, std::as_bytes(std::span(first_alive_)));
    checkpoint.add(kGaitsWalked, std::as_bytes(std::span(&gaits_, 1)));
    if (diagrams_) checkpoint.add(kDiagrams, std::as_bytes(std::span(&*diagrams_, 1)));
    saveCheckpoint(folder_->path(), checkpoint);
    folder_->keep();
}

void BakeWriter::write(const Frame& frame) {
    const std::size_t values = description_.agents.size() * kComponents;
    if (frame.index != frames_) throw std::invalid_argument("frames come in order");
    if (frame.positions.size() != values || frame.directions.size() != values ||
        frame.states.size() != values)
        throw std::invalid_argument("a frame has three values for each person in each stream");
    trackPeople(frame);
    const glm::dvec2 shift = description_.scene_origin - description_.output_origin;
    for (std::size_t i = 0; i < values; i += kComponents) {
        shifted_[i] = static_cast<float>(frame.positions[i] + shift.x);
        shifted_[i + 1] = static_cast<float>(frame.positions[i + 1] + shift.y);
        shifted_[i + 2] = frame.positions[i + 2];
    }
    positions_.append(shifted_);
    directions_.append(frame.directions);
    states_.append(frame.states);
    if (grounds_) {
        if (frame.grounds.size() != values) throw std::invalid_argument("a frame of this bake has grounds");
        grounds_->append(frame.grounds);
    }
    if (densities_) {
        if (frame.densities.size() != values)
            throw std::invalid_argument("a frame of this bake has densities");
        densities_->append(frame.densities);
    }
    ++frames_;
}

/// Kept here rather than taken from the account, so that what is filled in always agrees with the alive
/// flags.
void BakeWriter::trackPeople(const Frame& frame) {
    for (std::size_t row = 0; row < first_alive_.size(); ++row) {
        const float activity = frame.states[row * kComponents];
        if (activity <= 0.5f) continue;
        if (first_alive_[row] == kNone) first_alive_[row] = frame.index;
        gaits_ |= 1u << recording::gaitOf(activity);
    }
}

void BakeWriter::writeDiagram(const Frame& frame) {
    if (!frame.diagram || description_.diagram_every == 0 || frame.index % description_.diagram_every != 0)
        return;
    const DiagramImage& image = *frame.diagram;
    const std::string name = diagramName(frame.index);
    writeDiagramExr(folder_->path() / name, image, frame.densities, description_.scene_origin, frame.index,
                    description_.fps);
    diagram_files_.push_back(name);
    if (!diagrams_) {
        const glm::dvec2 minimum =
            description_.scene_origin + glm::dvec2(image.minimum) - description_.output_origin;
        diagrams_ = DiagramSummary{0, image.width, image.height, image.pixels_per_metre, minimum};
    }
    ++diagrams_->count;
}

void BakeWriter::finishStreams() {
    positions_.finish(first_alive_, kPositionRule);
    directions_.finish(first_alive_, kDirectionRule);
    states_.finish(first_alive_, kStateRule);
    if (grounds_) grounds_->finish(first_alive_, kGroundRule);
    if (densities_) densities_->finish(first_alive_, kDensityRule);
}

BakeOutcome BakeWriter::writeAll(const Account& account, const BakeTiming& timing, bool complete) {
    BakeOutcome outcome;
    outcome.complete = complete;
    outcome.frames = frames_;
    outcome.account = countOutcomes(account);
    outcome.timing = timing;
    outcome.gaits = gaits_;
    outcome.diagrams = diagrams_;
    std::vector<std::string> files{"layout.json", "agents.csv"};
    writeFile(folder_->path() / files[0], description_.layout_text);
    writeFile(folder_->path() / files[1], agentTable(description_, account));
    finishStreams();
    for (const Stream* stream : streams())
        for (const char* extension : {".npy", ".pc2"})
            files.push_back("streams/" + stream->name + extension);
    if (description_.terrain) {
        files.push_back("terrain.glb");
        writeTerrainGlb(folder_->path() / files.back(), description_);
    }
    if (description_.gltf) {
        files.push_back("crowd.glb");
        outcome.gltf =
            writeCrowdGlb(folder_->path() / files.back(), description_,
                          {StreamReader(positions_.npy.path()), StreamReader(directions_.npy.path()),
                           StreamReader(states_.npy.path())});
    }
    files.insert(files.end(), diagram_files_.begin(), diagram_files_.end());
    for (const std::string& file : files)
        outcome.files.push_back({file, hashFile(folder_->path() / file)});
    writeFile(
        folder_->path() / "bake.json",
        bakeManifest(description_, outcome).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) +
            "\n");
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
        std::filesystem::remove(path);
}

BakeResult BakeWriter::finish(const Account& account, const BakeTiming& timing) {
    if (frames_ != description_.frames)
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
