// SPDX-License-Identifier: Apache-2.0
#include "io/bake_writer.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "io/diagram/diagram_exr.h"
#include "io/files/output_file.h"

namespace throng::io {
namespace {

// What rows hold before they enter (docs/bake.md): where they will appear, facing as they will, standing
// still, not alive, with the gait phase they will start from.
constexpr std::array kPositionRule{BackFill::first_alive, BackFill::first_alive, BackFill::first_alive};
constexpr std::array kDirectionRule{BackFill::first_alive, BackFill::first_alive, BackFill::zero};
constexpr std::array kDensityRule{BackFill::keep, BackFill::keep, BackFill::keep};
constexpr std::array kStateRule{BackFill::keep, BackFill::first_alive, BackFill::first_alive};

}  // namespace

BakeWriter::Stream::Stream(const std::filesystem::path& folder, const std::string& stream_name,
                           const BakeDescription& description)
    : name(stream_name),
      npy(folder / (stream_name + ".npy"), StreamFormat::npy,
          static_cast<std::uint32_t>(description.agents.size()), description.frames),
      pc2(folder / (stream_name + ".pc2"), StreamFormat::pc2,
          static_cast<std::uint32_t>(description.agents.size()), description.frames) {}

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

BakeWriter::BakeWriter(BakeDescription description)
    : description_(std::move(description)),
      folder_(description_.output, description_.force),
      streams_folder_(folder_.addFolder("streams")),
      positions_(streams_folder_, "pos", description_),
      directions_(streams_folder_, "dir", description_),
      states_(streams_folder_, "state", description_),
      first_alive_(description_.agents.size(), kNone),
      shifted_(description_.agents.size() * kComponents) {
    if (description_.diagram_every > 0) folder_.addFolder("diagrams");
    if (description_.densities) densities_.emplace(streams_folder_, "density", description_);
}

void BakeWriter::write(const Frame& frame) {
    const std::size_t values = description_.agents.size() * kComponents;
    if (frame.index != frames_) throw std::invalid_argument("frames come in order");
    if (frame.positions.size() != values || frame.directions.size() != values ||
        frame.states.size() != values)
        throw std::invalid_argument("a frame has three values for each person in each stream");
    trackFirstAlive(frame);
    const glm::dvec2 shift = description_.scene_origin - description_.output_origin;
    for (std::size_t i = 0; i < values; i += kComponents) {
        shifted_[i] = static_cast<float>(frame.positions[i] + shift.x);
        shifted_[i + 1] = static_cast<float>(frame.positions[i + 1] + shift.y);
        shifted_[i + 2] = frame.positions[i + 2];
    }
    positions_.append(shifted_);
    directions_.append(frame.directions);
    states_.append(frame.states);
    if (densities_) {
        if (frame.densities.size() != values)
            throw std::invalid_argument("a frame of this bake has densities");
        densities_->append(frame.densities);
    }
    if (frame.diagram && description_.diagram_every > 0 && frame.index % description_.diagram_every == 0)
        writeDiagram(frame);
    ++frames_;
}

/// Kept here rather than taken from the account, so that what is filled in always agrees with the alive
/// flags.
void BakeWriter::trackFirstAlive(const Frame& frame) {
    for (std::size_t row = 0; row < first_alive_.size(); ++row)
        if (first_alive_[row] == kNone && frame.states[row * kComponents] > 0.5f)
            first_alive_[row] = frame.index;
}

void BakeWriter::writeDiagram(const Frame& frame) {
    const DiagramImage& image = *frame.diagram;
    const std::string name = fmt::format("diagrams/diagram.{:04}.exr", frame.index + 1);
    writeDiagramExr(folder_.path() / name, image, frame.densities, description_.scene_origin, frame.index,
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
    if (densities_) densities_->finish(first_alive_, kDensityRule);
}

BakeOutcome BakeWriter::writeAll(const Account& account, const BakeTiming& timing, bool complete) {
    BakeOutcome outcome;
    outcome.complete = complete;
    outcome.frames = frames_;
    outcome.account = countOutcomes(account);
    outcome.timing = timing;
    outcome.diagrams = diagrams_;
    std::vector<std::string> files{"layout.json", "agents.csv"};
    writeFile(folder_.path() / files[0], description_.layout_text);
    writeFile(folder_.path() / files[1], agentTable(description_, account));
    finishStreams();
    for (const Stream* stream : {&positions_, &directions_, &states_, densities_ ? &*densities_ : nullptr})
        for (const char* extension : {".npy", ".pc2"})
            if (stream) files.push_back("streams/" + stream->name + extension);
    if (description_.gltf) {
        files.push_back("crowd.glb");
        outcome.gltf =
            writeCrowdGlb(folder_.path() / files.back(), description_,
                          {StreamReader(positions_.npy.path()), StreamReader(directions_.npy.path()),
                           StreamReader(states_.npy.path())});
    }
    files.insert(files.end(), diagram_files_.begin(), diagram_files_.end());
    for (const std::string& file : files)
        outcome.files.push_back({file, hashFile(folder_.path() / file)});
    writeFile(
        folder_.path() / "bake.json",
        bakeManifest(description_, outcome).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) +
            "\n");
    return outcome;
}

BakeResult BakeWriter::resultAt(std::filesystem::path path, const BakeOutcome& outcome) const {
    return {std::move(path), outcome.frames, outcome.account, outcome.gltf, diagrams_ ? diagrams_->count : 0};
}

BakeResult BakeWriter::finish(const Account& account, const BakeTiming& timing) {
    if (frames_ != description_.frames)
        throw std::logic_error("frames are missing: only finishPartial() can be used");
    const BakeOutcome outcome = writeAll(account, timing, true);
    return resultAt(folder_.commit(), outcome);
}

BakeResult BakeWriter::finishPartial(const Account& account, const BakeTiming& timing) {
    const BakeOutcome outcome = writeAll(account, timing, false);
    return resultAt(folder_.commitPartial(), outcome);
}

}  // namespace throng::io
