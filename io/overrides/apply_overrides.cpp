// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/apply_overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <map>
#include <numbers>

#include "base/build_name.h"
#include "base/files/hash.h"
#include "base/files/output_file.h"
#include "io/bake_copy.h"
#include "io/bake_folder.h"
#include "io/gltf/crowd_glb.h"
#include "io/gltf/terrain_file.h"
#include "io/manifest.h"
#include "io/overrides/agent_table_edit.h"
#include "io/overrides/row_sampler.h"
#include "io/streams/stream_files.h"
#include "recording/footing.h"

namespace throng::io {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
using authoring::PersonChange;

constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

/// A row that changes, and what came of it.
struct ChangedRow {
    std::uint32_t row = 0;
    PersonChange change;
    std::optional<std::uint32_t> first = {};  ///< frame of its entry in the source
    std::array<float, kComponents> pivot{};   ///< its place there
    std::uint32_t first_alive = kNever;       ///< in the new bake
    glm::vec2 place{0.0f};                    ///< in the frame before
    bool is_held = false;
};

/// Of a tint that is a colour.
std::optional<std::uint32_t> colourOf(const std::string& tint) {
    std::uint32_t colour = 0;
    if (!tint.starts_with('#')) return std::nullopt;
    const auto [end, error] = std::from_chars(tint.data() + 1, tint.data() + tint.size(), colour, 16);
    if (error != std::errc() || end != tint.data() + tint.size()) return std::nullopt;
    return colour & 0xffffffu;
}

class Application {
  public:
    Application(CrowdReader& crowd, std::span<const RowChange> changes, const ApplyOptions& options)
        : crowd_(crowd),
          source_(crowd.bake()),
          options_(options),
          folder_(options.output, options.force),
          table_(source_),
          sampler_(crowd.streams()),
          minimum_(source_.minimum),
          maximum_(source_.maximum) {
        folder_.addFolder("streams");
        for (const StreamInfo& info : kStreams)
            if (source_.streams[info.id])
                files_.emplace_back(folder_.path(), info, source_.formats, source_.agents, source_.frames);
        requireInside(source_, source_.manifest.contains("terrain")
                                   ? std::vector<std::string>{"agents.csv", "terrain.glb"}
                                   : std::vector<std::string>{"agents.csv"});
        requireSound(source_, [this](const std::string& path) {
            return !isWrittenAnew(path) || path == "agents.csv" || isReadStream(source_, path);
        });
        for (const RowChange& each : changes)
            rows_.push_back(prepared(each));
        if (source_.manifest.contains("terrain")) readTerrainBack();
    }

    /// False when it was stopped.
    bool writeStreams() {
        for (std::uint32_t frame = 0; frame < source_.frames; ++frame) {
            read(crowd_.frame(frame));
            for (ChangedRow& each : rows_)
                change(each, frame);
            for (StreamFiles& stream : files_)
                stream.append(frame_[stream.info().id]);
            if (!options_.go_on(frame + 1)) return false;
        }
        for (StreamFiles& stream : files_)
            stream.finish();
        return true;
    }

    ApplyResult finish() {
        writeTable();
        copyTheRest();
        const Json gltf = options_.gltf ? writeGltf() : Json(nullptr);
        writeManifest(gltf);
        const auto held = std::ranges::count_if(rows_, [](const ChangedRow& each) { return each.is_held; });
        return {folder_.commit(), static_cast<std::uint32_t>(held)};
    }

  private:
    void read(const CrowdFrame& frame) {
        for (const StreamFiles& stream : files_) {
            const std::span<const float> values = frame[stream.info().id];
            frame_[stream.info().id].assign(values.begin(), values.end());
        }
    }

    std::span<float, kComponents> row(Stream stream, std::uint32_t index) {
        return rowOf(std::span(frame_[stream]), index);
    }

    /// Who is moved or comes at another time stands on the ground anew.
    void readTerrainBack() {
        const Json& facts = source_.manifest["terrain"];
        terrain_.emplace();
        terrain_->mesh = std::make_shared<const authoring::TerrainMesh>(
            readTerrain(source_.folder / "terrain.glb", authoring::TerrainSettings{}));
        glm::dvec2 furthest(0.0);
        for (const ChangedRow& each : rows_)
            furthest = glm::max(furthest, glm::abs(glm::dvec2(each.change.move.x, each.change.move.y)));
        terrain_->surface = std::make_shared<const authoring::Terrain>(
            *terrain_->mesh, facts.value("surface", "highest") == "highest", source_.origin,
            glm::vec2(source_.minimum - furthest), glm::vec2(source_.maximum + furthest));
        terrain_->source = facts.value("source", "");
        for (std::size_t i = 0; i < source_.walls.size(); ++i) {
            const Json ground =
                source_.manifest["geometry"]["walls"].at(i).value("ground", Json::array({0.0, 0.0}));
            terrain_->along_walls.emplace_back(ground.at(0).get<double>(), ground.at(1).get<double>());
        }
        // Of floors above each other, nobody knows any more who walks on which: heights stay what they are.
        if (!source_.manifest.contains("levels"))
            footing_.emplace(terrain_->surface, source_.agents, source_.fps);
    }

    void stand(ChangedRow& each, const RowSample& sample) {
        const glm::vec2 place(sample[Stream::pos][0], sample[Stream::pos][1]);
        const glm::vec2 heading(sample[Stream::dir][0], sample[Stream::dir][1]);
        const std::array<float, kComponents>& state = sample[Stream::state];
        const bool is_alive = state[0] > 0.5f, was_alive = each.first_alive != kNever;
        recording::Stance stance = footing_->last(each.row);
        if (is_alive) {
            const recording::GaitTrack gait{state[2], recording::gaitOf(state[0])};
            stance = footing_->stand(each.row, place, heading,
                                     was_alive ? place - each.place : glm::vec2(0.0f), gait);
            each.place = place;
        } else if (!was_alive) {
            stance = footing_->entering(place, heading);
        }
        row(Stream::pos, each.row)[2] = stance.height + static_cast<float>(each.change.move.z);
        const auto ground = row(Stream::ground, each.row);
        ground[0] = stance.along;
        ground[1] = stance.across;
        ground[2] = stance.ground;
    }

    ChangedRow prepared(const RowChange& each) const {
        ChangedRow changed{each.row, each.change};
        changed.first = table_.frame(each.row, "spawn_frame");
        if (changed.first && *changed.first >= source_.frames) changed.first.reset();
        if (changed.first) crowd_.streams()[Stream::pos].readRows(*changed.first, each.row, changed.pivot);
        return changed;
    }

    /// In the frame under way.
    RowSample asItIs(std::uint32_t index) {
        RowSample sample;
        for (const StreamFiles& stream : files_)
            std::ranges::copy(row(stream.info().id, index), sample[stream.info().id].begin());
        return sample;
    }

    void change(ChangedRow& each, std::uint32_t frame) {
        const bool is_retimed = each.change.retimes() && each.first;
        const double at = is_retimed ? sourceFrame(frame, *each.first, each.change) : frame;
        RowSample sample = is_retimed ? sampler_.at(each.row, at, each.change.speed) : asItIs(each.row);
        const bool is_beyond = at < 0.0 || at > static_cast<double>(source_.frames - 1);
        each.is_held = each.is_held || (is_beyond && sample[Stream::state][0] > 0.5f);
        changeSample(sample, each.pivot, each.change);
        for (const StreamFiles& stream : files_)
            std::ranges::copy(sample[stream.info().id], row(stream.info().id, each.row).begin());
        if (footing_ && (each.change.moves() || each.change.retimes())) stand(each, sample);
        if (sample[Stream::state][0] <= 0.5f) return;
        each.first_alive = std::min(each.first_alive, frame);
        const glm::dvec2 place(sample[Stream::pos][0], sample[Stream::pos][1]);
        minimum_ = glm::dvec2(std::min(minimum_.x, place.x), std::min(minimum_.y, place.y));
        maximum_ = glm::dvec2(std::max(maximum_.x, place.x), std::max(maximum_.y, place.y));
    }

    void writeTable() {
        table_.addColumn("scale", "1");
        table_.addColumn("tint", "");
        table_.addColumn("overrides", "");
        for (const ChangedRow& each : rows_)
            editRow(each);
        writeFile(folder_.path() / "agents.csv", table_.text());
    }

    void editRow(const ChangedRow& each) {
        const PersonChange& change = each.change;
        const std::uint32_t row = each.row;
        table_.set(row, "overrides", fmt::format("{}", fmt::join(authoring::changeWords(change), " ")));
        if (change.scale) table_.set(row, "scale", fmt::format("{}", *change.scale));
        if (change.tint) table_.set(row, "tint", change.tint->text);
        if (change.character) table_.set(row, "variation", fmt::format("{}", *change.character));
        if (change.moves()) moveGoal(each);
        if (change.hides())
            refuse(row, change.hide ? "hidden by an override" : "a hero outside the crowd");
        else if (change.retimes() && each.first)
            retimeRow(each);
    }

    void refuse(std::uint32_t row, const std::string& reason) {
        table_.set(row, "outcome", "refused");
        table_.set(row, "reason", reason);
        table_.set(row, "spawn_frame", "");
        table_.set(row, "arrival_frame", "");
    }

    void retimeRow(const ChangedRow& each) {
        if (each.first_alive == kNever) return refuse(each.row, "retimed out of the shot");
        table_.set(each.row, "spawn_frame", std::to_string(each.first_alive));
        const std::optional<std::uint32_t> arrival = table_.frame(each.row, "arrival_frame");
        if (!arrival) return;
        const double first = *each.first;
        const double frame =
            std::ceil(first + each.change.delay + (*arrival - first) / each.change.speed - 1.0e-9);
        const bool is_in_shot = frame < static_cast<double>(source_.frames);
        table_.set(each.row, "arrival_frame", is_in_shot ? fmt::format("{:.0f}", std::max(frame, 0.0)) : "");
        if (!is_in_shot) table_.set(each.row, "outcome", "walking");
    }

    /// Goals are the world's, where the streams start from the bake's origin.
    void moveGoal(const ChangedRow& each) {
        const glm::dvec2 pivot = source_.origin + glm::dvec2(each.pivot[0], each.pivot[1]);
        const glm::dvec2 goal(table_.number(each.row, "goal_x"), table_.number(each.row, "goal_y"));
        const double angle = each.change.turn * std::numbers::pi / 180.0;
        const glm::dvec2 arm = goal - pivot;
        const double x = pivot.x + std::cos(angle) * arm.x - std::sin(angle) * arm.y + each.change.move.x;
        const double y = pivot.y + std::sin(angle) * arm.x + std::cos(angle) * arm.y + each.change.move.y;
        table_.set(each.row, "goal_x", fmt::format("{}", x));
        table_.set(each.row, "goal_y", fmt::format("{}", y));
    }

    static bool isWrittenAnew(const std::string& path) {
        return path == "agents.csv" || path == "crowd.glb" || path.starts_with("diagrams/") ||
               isStreamFile(path);
    }

    void copyTheRest() {
        for (const Bake::File& file : source_.files) {
            if (isWrittenAnew(file.path)) continue;
            copyBakeFile(source_, file.path, folder_.path());
            copied_.push_back(file.path);
        }
    }

    Json writeGltf() {
        const recording::BakeDescription description = describe();
        const GltfSummary summary =
            writeCrowdGlb(folder_.path() / "crowd.glb", description,
                          {folder_.path(), source_.streams, source_.formats, source_.frames, source_.agents});
        return {{"file", "crowd.glb"}, {"agents", summary.agents}, {"of", summary.of}};
    }

    /// What the glTF writer has to know, from the source's files.
    recording::BakeDescription describe() const {
        recording::BakeDescription description;
        description.name = source_.name;
        description.fps = source_.fps;
        description.frames = source_.frames;
        description.output_origin = description.scene_origin = source_.origin;
        description.minimum = source_.origin + minimum_;
        description.maximum = source_.origin + maximum_;
        description.roads = source_.roads;
        description.areas = source_.areas;
        description.walls = source_.walls;
        const auto toWorld = [&](std::vector<glm::dvec2>& points) {
            for (glm::dvec2& point : points)
                point += source_.origin;
        };
        for (authoring::Road& road : description.roads)
            toWorld(road.centreline);
        for (authoring::Area& area : description.areas)
            toWorld(area.polygon);
        for (authoring::Wall& wall : description.walls)
            toWorld(wall.points);
        description.terrain = terrain_;
        std::map<std::string, std::uint32_t> groups;
        for (std::uint32_t row = 0; row < table_.rows(); ++row) {
            const std::string& group = table_.at(row, "group");
            const auto [known, is_new] =
                groups.emplace(group, static_cast<std::uint32_t>(description.groups.size()));
            if (is_new) description.groups.push_back({group, table_.at(row, "kind") == "flow"});
            recording::BakeAgent agent;
            agent.group = known->second;
            agent.radius = static_cast<float>(table_.number(row, "radius"));
            agent.scale = table_.number(row, "scale");
            agent.colour = colourOf(table_.at(row, "tint"));
            description.agents.push_back(agent);
        }
        description.gltf_agents = options_.gltf_agents;
        return description;
    }

    Json account() const {
        std::map<std::string, std::uint32_t> outcomes, reasons;
        for (std::uint32_t row = 0; row < table_.rows(); ++row) {
            const std::string& outcome = table_.at(row, "outcome");
            ++outcomes[outcome];
            if (outcome == "refused") ++reasons[table_.at(row, "reason")];
        }
        return {{"agents", table_.rows()},
                {"spawned", outcomes["walking"] + outcomes["arrived"]},
                {"walking", outcomes["walking"]},
                {"arrived", outcomes["arrived"]},
                {"refused", outcomes["refused"]},
                {"refused_reasons", reasons.empty() ? Json::object() : Json(reasons)}};
    }

    void writeManifest(const Json& gltf) {
        Json manifest = source_.manifest;
        manifest["generator"] = "throng " THRONG_VERSION;
        manifest["build"] = buildName();
        manifest["inputs"] = "xxh3:" + hashText(manifest.value("inputs", "") + "\n" + options_.identity);
        std::uint32_t variations = manifest.value("variations", 1u);
        for (const ChangedRow& each : rows_)
            if (each.change.character) variations = std::max(variations, *each.change.character + 1);
        manifest["variations"] = variations;
        manifest["bounds"] = {{"min", {minimum_.x, minimum_.y}}, {"max", {maximum_.x, maximum_.y}}};
        manifest["gltf"] = gltf;
        manifest["diagrams"] = nullptr;
        manifest["account"] = account();
        manifest["applied"] = options_.applied;
        std::vector<std::string> files{"agents.csv"};
        files.insert(files.end(), copied_.begin(), copied_.end());
        for (const std::string& file : filesOf(files_))
            files.push_back(file);
        if (!gltf.is_null()) files.emplace_back("crowd.glb");
        manifest["files"] = listOfFiles(folder_.path(), files);
        writeFile(folder_.path() / "bake.json", manifestText(std::move(manifest)));
    }

    CrowdReader& crowd_;
    const Bake& source_;
    const ApplyOptions& options_;
    BakeFolder folder_;
    AgentTableEdit table_;
    RowSampler sampler_;
    std::vector<StreamFiles> files_;
    PerStream<std::vector<float>> frame_;            ///< the one under way
    std::optional<recording::BakeTerrain> terrain_;  // none on flat ground
    std::optional<recording::Footing> footing_;
    std::vector<ChangedRow> rows_;
    std::vector<std::string> copied_;
    glm::dvec2 minimum_;  ///< bounds, widened to where people have been moved
    glm::dvec2 maximum_;
};

}  // namespace

std::optional<ApplyResult> applyOverrides(CrowdReader& source, std::span<const RowChange> changes,
                                          const ApplyOptions& options) {
    Application application(source, changes, options);
    if (!application.writeStreams()) return std::nullopt;
    return application.finish();
}

}  // namespace throng::io
