// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/apply_overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "base/build_name.h"
#include "base/files/hash.h"
#include "base/files/output_file.h"
#include "io/bake_copy.h"
#include "io/bake_folder.h"
#include "io/door_file.h"
#include "io/gltf/crowd_glb.h"
#include "io/gltf/terrain_file.h"
#include "io/lift_file.h"
#include "io/manifest.h"
#include "io/overrides/applied_rows.h"
#include "io/streams/stream_files.h"
#include "io/vehicle_file.h"
#include "recording/footing.h"

namespace throng::io {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

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
    Application(LayeredCrowd& crowd, const ApplyOptions& options)
        : crowd_(crowd),
          source_(crowd.bake()),
          options_(options),
          folder_(options.output, options.force),
          table_(crowd.table()),
          minimum_(source_.minimum),
          maximum_(source_.maximum) {
        folder_.addFolder("streams");
        for (const StreamInfo& info : kStreams)
            if (source_.streams[info.id])
                files_.emplace_back(folder_.path(), info, source_.formats, crowd.rows(), source_.frames);
        requireInside(source_, source_.manifest.contains("terrain")
                                   ? std::vector<std::string>{"agents.csv", "terrain.glb"}
                                   : std::vector<std::string>{"agents.csv"});
        requireSound(source_, [this](const std::string& path) {
            return !isWrittenAnew(path) || path == "agents.csv" || isReadStream(source_, path);
        });
        for (std::uint32_t row = 0; row < crowd.rows(); ++row)
            if (crowd.plan(row).isChanged()) rows_.push_back({row});
        if (options.watch_overlaps) watch_.emplace(crowd);
        if (source_.manifest.contains("terrain")) readTerrainBack();
    }

    /// False when it was stopped.
    bool writeStreams() {
        for (std::uint32_t frame = 0; frame < source_.frames; ++frame) {
            const CrowdFrame now = crowd_.source().frame(frame);
            read(now);
            for (ChangedRow& each : rows_)
                change(each, now);
            if (watch_) watch_->see(frame, frame_);
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
        ApplyResult result;
        if (watch_) result.overlaps = watch_->found();
        if (watch_) result.in_walls = watch_->inWalls();
        writeManifest(gltf, result);
        result.held = static_cast<std::uint32_t>(
            std::ranges::count_if(rows_, [](const ChangedRow& each) { return each.is_held; }));
        result.path = folder_.commit();
        return result;
    }

  private:
    void read(const CrowdFrame& frame) {
        for (const StreamFiles& stream : files_) {
            const std::span<const float> values = frame[stream.info().id];
            frame_[stream.info().id].assign(values.begin(), values.end());
            frame_[stream.info().id].resize(crowd_.rows() * kComponents);
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
            furthest = glm::max(furthest, reachOf(crowd_.plan(each.row)));
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
            footing_.emplace(terrain_->surface, crowd_.rows(), source_.fps);
    }

    /// m over the ground.
    static double liftOf(const RowPlan& plan) {
        double lift = 0.0;
        for (const Step& step : plan.steps)
            lift += step.change.move.z;
        return lift;
    }

    void stand(ChangedRow& each, const RowSample& sample) {
        const glm::vec2 place(sample[Stream::pos][0], sample[Stream::pos][1]);
        const glm::vec2 heading(sample[Stream::dir][0], sample[Stream::dir][1]);
        const std::array<float, kComponents>& state = sample[Stream::state];
        const bool is_alive = state[0] > 0.5f, was_alive = each.first_alive != kNever;
        recording::Stance stance = footing_->last(each.row);
        if (is_alive) {
            const recording::GaitTrack gait{state[2], recording::gaitOf(state[0])};
            const glm::vec2 moved = was_alive ? place - each.place : glm::vec2(0.0f);
            stance = footing_->stand(each.row, {place, heading, moved}, gait);
            each.place = place;
        } else if (!was_alive) {
            stance = footing_->entering(place, heading);
        }
        row(Stream::pos, each.row)[2] = stance.height + static_cast<float>(liftOf(crowd_.plan(each.row)));
        const auto ground = row(Stream::ground, each.row);
        ground[0] = stance.along;
        ground[1] = stance.across;
        ground[2] = stance.ground;
    }

    /// m, along both axes, that somebody may come to be outside of the site.
    glm::dvec2 reachOf(const RowPlan& plan) const {
        glm::dvec2 reach(plan.bent);
        for (const Step& step : plan.steps) {
            reach += glm::abs(glm::dvec2(step.change.move));
            if (!step.is_of_layer || step.change.turn == 0.0) continue;
            const glm::dvec2 pivot(step.pivot[0], step.pivot[1]);  // round it, from the furthest corner
            reach += 2.0 * glm::length(glm::max(glm::abs(source_.minimum - pivot),
                                                glm::abs(source_.maximum - pivot)));
        }
        return reach;
    }

    void change(ChangedRow& each, const CrowdFrame& frame) {
        const RowMoment moment = crowd_.at(each.row, frame);
        const RowSample& sample = moment.sample;
        const RowPlan& plan = crowd_.plan(each.row);
        each.is_held = each.is_held || (moment.is_beyond && sample[Stream::state][0] > 0.5f);
        for (const StreamFiles& stream : files_)
            std::ranges::copy(sample[stream.info().id], row(stream.info().id, each.row).begin());
        if (footing_ && plan.stands_anew) stand(each, sample);
        if (sample[Stream::state][0] <= 0.5f) return;
        each.first_alive = std::min(each.first_alive, frame.index());
        const glm::dvec2 place(sample[Stream::pos][0], sample[Stream::pos][1]);
        minimum_ = glm::dvec2(std::min(minimum_.x, place.x), std::min(minimum_.y, place.y));
        maximum_ = glm::dvec2(std::max(maximum_.x, place.x), std::max(maximum_.y, place.y));
    }

    void writeTable() {
        table_.addColumn("scale", "1");
        table_.addColumn("tint", "");
        table_.addColumn("overrides", "");
        for (const ChangedRow& each : rows_)
            writeAppliedRow(crowd_, each);
        writeFile(folder_.path() / "agents.csv", table_.text());
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
        const std::vector<float> vehicles =
            source_.vehicles.empty() ? std::vector<float>() : readVehicles(source_);
        const std::vector<float> doors = source_.doors.empty() ? std::vector<float>() : readDoors(source_);
        const std::vector<float> lifts = source_.lifts.empty() ? std::vector<float>() : readLifts(source_);
        const GltfSummary summary =
            writeCrowdGlb(folder_.path() / "crowd.glb", description,
                          {folder_.path(), source_.streams, source_.formats, source_.frames, crowd_.rows()},
                          {{vehicles, doors}, {source_.lifts, lifts}});
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
        description.patches = source_.patches;
        description.walls = source_.walls;
        description.traffic = source_.traffic;
        description.vehicles = source_.vehicles;
        description.doors = source_.doors;
        description.seats = source_.seats;
        description.has_poses = source_.has_poses;
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
        for (recording::BakeSeats& seats : description.seats)
            for (recording::BakeSeatRow& row : seats.rows)
                toWorld(row.line);
        for (recording::BakeSeats& seats : description.seats)
            for (recording::BakeAisle& aisle : seats.aisles) {
                toWorld(aisle.line);
                if (aisle.passage) toWorld(aisle.passage->line);
                for (recording::BakeFlight& flight : aisle.flights)
                    toWorld(flight.line);
            }
        for (authoring::Lane& lane : description.traffic.lanes)
            toWorld(lane.points);
        for (authoring::Zebra& crossing : description.traffic.crossings)
            toWorld(crossing.polygon);
        description.terrain = terrain_;
        std::map<std::string, std::uint32_t> groups;
        for (std::uint32_t row = 0; row < table_.rows(); ++row) {
            const std::string& group = table_.at(row, "group");
            const auto [known, is_new] =
                groups.emplace(group, static_cast<std::uint32_t>(description.groups.size()));
            if (is_new)
                description.groups.push_back(
                    {group, table_.at(row, "kind") == "flow", table_.at(row, "kind") == "given"});
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

    static Json inWallsJson(std::span<const InWall> people) {
        Json list = Json::array();
        for (const InWall& each : people.first(std::min(people.size(), kMostTold)))
            list.push_back({{"row", each.row}, {"wall", each.wall}, {"frames", {each.first, each.last}}});
        return list;
    }

    static Json overlapsJson(std::span<const Overlap> overlaps) {
        Json list = Json::array();
        for (const Overlap& each : overlaps.first(std::min(overlaps.size(), kMostTold)))
            list.push_back({{"rows", {each.row, each.other}},
                            {"frames", {each.first, each.last}},
                            {"depth", each.depth},
                            {"deepest", each.deepest}});
        return {{"pairs", overlaps.size()}, {"deepest", list}};
    }

    void writeManifest(const Json& gltf, const ApplyResult& result) {
        Json manifest = source_.manifest;
        manifest["generator"] = "throng " THRONG_VERSION;
        manifest["build"] = buildName();
        manifest["inputs"] = "xxh3:" + hashText(manifest.value("inputs", "") + "\n" + options_.identity);
        std::uint32_t variations = manifest.value("variations", 1u);
        for (const ChangedRow& each : rows_)
            for (const Step& step : crowd_.plan(each.row).steps)
                if (step.change.character) variations = std::max(variations, *step.change.character + 1);
        manifest["variations"] = variations;
        manifest["bounds"] = {{"min", {minimum_.x, minimum_.y}}, {"max", {maximum_.x, maximum_.y}}};
        manifest["gltf"] = gltf;
        manifest["diagrams"] = nullptr;
        manifest["account"] = account();
        manifest["agents"] = crowd_.rows();
        manifest["applied"] = options_.applied;
        if (watch_) manifest["applied"]["overlaps"] = overlapsJson(result.overlaps);
        if (watch_) manifest["applied"]["in_walls"] = inWallsJson(result.in_walls);
        std::vector<std::string> files{"agents.csv"};
        files.insert(files.end(), copied_.begin(), copied_.end());
        for (const std::string& file : filesOf(files_))
            files.push_back(file);
        if (!gltf.is_null()) files.emplace_back("crowd.glb");
        manifest["files"] = listOfFiles(folder_.path(), files);
        writeFile(folder_.path() / "bake.json", manifestText(std::move(manifest)));
    }

    static constexpr std::size_t kMostTold = 1000;  // overlaps

    LayeredCrowd& crowd_;
    const Bake& source_;
    const ApplyOptions& options_;
    BakeFolder folder_;
    AgentTableEdit& table_;
    std::optional<OverlapWatch> watch_;
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

void changeRows(LayeredCrowd& crowd, std::span<const RowChange> changes) {
    for (const RowChange& each : changes) {
        Step step;
        step.change = each.change;
        crowd.add(each.row, std::move(step));
        crowd.addWords(each.row, authoring::changeWords(each.change));
    }
}

std::optional<ApplyResult> writeApplied(LayeredCrowd& crowd, const ApplyOptions& options) {
    Application application(crowd, options);
    if (!application.writeStreams()) return std::nullopt;
    return application.finish();
}

}  // namespace throng::io
