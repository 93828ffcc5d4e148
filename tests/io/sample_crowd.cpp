// SPDX-License-Identifier: Apache-2.0
#include "sample_crowd.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace throng::test {
namespace {

constexpr double kFps = 24.0;
constexpr double kHalfLength = 15.0;  // m, of a lane
constexpr double kSway = 0.2;         // m
constexpr double kStride = 1.4;       // m
constexpr float kNotYet = -999.0f;
constexpr std::uint32_t kVariations = 4;
const glm::dvec2 kToScene(-3.0, 2.0);  // the scene's origin is not the output's

double laneOffset(std::uint32_t row) {
    return (static_cast<int>(row / 2 % 9) - 4) * 0.9;
}

double startAlongLane(std::uint32_t row) {
    return -kHalfLength + 0.6 * static_cast<double>(row / 18 % 40);
}

}  // namespace

std::uint32_t SampleCrowd::spawnFrame(std::uint32_t row) const {
    return row % 5 == 4 ? 1 + row % std::max(1u, options_.frames - 1) : 0;
}

std::uint32_t SampleCrowd::arrivalFrame(std::uint32_t row) const {
    const double seconds = (kHalfLength - startAlongLane(row)) / speed(row);
    return spawnFrame(row) + static_cast<std::uint32_t>(std::ceil(seconds * kFps));
}

bool SampleCrowd::isAlive(std::uint32_t row, std::uint32_t frame) const {
    return !isRefused(row) && frame >= spawnFrame(row) && frame < arrivalFrame(row);
}

double SampleCrowd::distance(std::uint32_t row, std::uint32_t frame) const {
    const std::uint32_t spawn = spawnFrame(row);
    const std::uint32_t last = arrivalFrame(row) - 1;
    return speed(row) * (std::clamp(frame, spawn, last) - spawn) / kFps;
}

glm::dvec2 SampleCrowd::position(std::uint32_t row, std::uint32_t frame) const {
    const double along = startAlongLane(row) + distance(row, frame);
    const double aside = laneOffset(row) + kSway * std::sin(along);
    return row % 2 == 0 ? glm::dvec2(along, aside) : glm::dvec2(aside, along);
}

double SampleCrowd::heading(std::uint32_t row, std::uint32_t frame) const {
    const double slope = kSway * std::cos(startAlongLane(row) + distance(row, frame));
    return row % 2 == 0 ? std::atan2(slope, 1.0) : std::atan2(1.0, slope);
}

double SampleCrowd::phase(std::uint32_t row, std::uint32_t frame) const {
    return 0.1 * (row % 10) + distance(row, frame) / kStride;
}

float SampleCrowd::extra(const StreamInfo& info, std::uint32_t row, std::uint32_t frame,
                         std::size_t component) const {
    if (isAskedFor(info) && !isAlive(row, frame)) return 0.0f;
    const auto place = static_cast<float>(static_cast<std::size_t>(info.id) * 100 + component * 10 + row % 8);
    return place + (info.components[component].is_whole ? static_cast<float>(frame)
                                                        : static_cast<float>(frame) / 512.0f);
}

namespace {

/// A square that rises by a tenth along x.
recording::BakeTerrain slope(glm::dvec2 centre, glm::dvec2 scene_origin, std::size_t walls) {
    constexpr double kHalf = 40.0;
    auto mesh = std::make_shared<authoring::TerrainMesh>();
    for (const glm::dvec2 corner :
         {glm::dvec2(-kHalf, -kHalf), {kHalf, -kHalf}, {kHalf, kHalf}, {-kHalf, kHalf}})
        mesh->positions.emplace_back(centre + corner, 0.1 * corner.x);
    mesh->normals.assign(4, glm::normalize(glm::vec3(-0.1f, 0.0f, 1.0f)));
    mesh->indices = {0, 1, 2, 0, 2, 3};
    recording::BakeTerrain terrain;
    terrain.surface =
        std::make_shared<authoring::Terrain>(*mesh, true, scene_origin, glm::vec2(-kHalf), glm::vec2(kHalf));
    terrain.mesh = mesh;
    terrain.source = "slope.glb";
    terrain.along_walls.resize(walls);
    return terrain;
}

}  // namespace

recording::BakeDescription SampleCrowd::description(const std::filesystem::path& output) const {
    recording::BakeDescription description;
    description.output = output;
    description.force = options_.force;
    description.name = "sample crossing";
    description.layout_text = "{\"throng\": 1, \"name\": \"sample crossing\"}\n";
    description.seed = 7;
    description.fps = kFps;
    description.frames = options_.frames;
    description.substeps = 2;
    description.duration = options_.frames / kFps;
    description.variations = kVariations;
    description.strides = {kStride};
    description.scene_origin = options_.origin + glm::dvec2(3.0, -2.0);
    description.output_origin = options_.origin;
    description.minimum = options_.origin - (kHalfLength + 1.0);
    description.maximum = options_.origin + (kHalfLength + 1.0);
    description.groups = {{"eastbound", true}, {"north, \"bound\"", false}};
    for (std::uint32_t row = 0; row < options_.rows; ++row)
        description.agents.push_back({row % 2, 0.22f + 0.01f * static_cast<float>(row % 7),
                                      static_cast<float>(speed(row)), row % kVariations, row,
                                      options_.origin + position(row, arrivalFrame(row))});

    const auto at = [&](double x, double y) { return options_.origin + glm::dvec2(x, y); };
    description.roads = {{"west-east", {at(-16, 0), at(16, 0)}, 9.6, true, {}},
                         {"south-north", {at(0, -16), at(0, 16)}, 9.6, true, {}}};
    description.areas = {{"square", {at(-6, -6), at(6, -6), at(6, 6), at(-6, 6)}, {}}};
    description.walls = {
        {"corner", {at(-16, 5.2), at(-5.2, 5.2), at(-5.2, 16)}, false, 0.3, 2.5, {}},
        {"block", {at(6, 6), at(6, 14), at(10, 14), at(10, 10), at(14, 10), at(14, 6)}, true, 0.0, 4.0, {}}};
    description.renderer = "none";
    description.driver = "none";
    description.gltf = options_.gltf;
    description.gltf_agents = options_.gltf_agents;
    description.formats = options_.formats;
    description.diagram_every = options_.diagram_every;
    if (!options_.every_stream) return description;
    description.terrain = slope(options_.origin, description.scene_origin, description.walls.size());
    for (const StreamInfo& info : kStreams)
        description.asked[info.id] = isAskedFor(info);
    return description;
}

Account SampleCrowd::account() const {
    Account account;
    for (std::uint32_t row = 0; row < options_.rows; ++row) {
        AgentOutcome outcome;
        if (isRefused(row)) {
            outcome.status = AgentStatus::refused;
            outcome.reason = "no room at the entry, which was \"full\"";
        } else {
            const bool arrived = arrivalFrame(row) < options_.frames;
            outcome.status = arrived ? AgentStatus::arrived : AgentStatus::walking;
            outcome.spawn_frame = spawnFrame(row);
            outcome.arrival_frame = arrived ? arrivalFrame(row) : kNone;
            outcome.distance_walked = static_cast<float>(distance(row, options_.frames));
            ++account.spawned;
            ++(arrived ? account.arrived : account.walking);
        }
        if (outcome.status == AgentStatus::refused) ++account.refused;
        account.agents.push_back(outcome);
    }
    return account;
}

PerStream<std::vector<float>> SampleCrowd::valuesOf(std::uint32_t frame) const {
    PerStream<std::vector<float>> values;
    for (std::uint32_t row = 0; row < options_.rows; ++row) {
        const bool has_values = isRefused(row) || frame >= spawnFrame(row);
        const bool alive = isAlive(row, frame);
        const glm::dvec2 p = position(row, frame) + kToScene;
        const double turn = heading(row, frame);
        const std::array<std::array<double, kComponents>, 3> moving{
            {{p.x, p.y, 0.0},
             {std::cos(turn), std::sin(turn), alive ? speed(row) : 0.0},
             {alive ? 1.0 : 0.0, row % kVariations * 1.0, phase(row, frame)}}};
        for (const StreamInfo& info : kStreams)
            for (std::size_t i = 0; i < kComponents; ++i) {
                const bool is_motion = info.source == StreamSource::motion;
                const double value =
                    is_motion ? moving[static_cast<std::size_t>(info.id)][i] : extra(info, row, frame, i);
                const bool is_known = has_values || isAskedFor(info);
                values[info.id].push_back(is_known ? static_cast<float>(value) : kNotYet);
            }
        if (!alive) values[Stream::state][row * kComponents] = 0.0f;
    }
    return values;
}

Frame SampleCrowd::frameOf(std::uint32_t index, const PerStream<std::vector<float>>& values) const {
    Frame frame{index};
    for (const StreamInfo& info : kStreams)
        if (info.source == StreamSource::motion || options_.every_stream) frame[info.id] = values[info.id];
    return frame;
}

SampleDiagram SampleCrowd::diagramOf(std::uint32_t index) const {
    std::vector<glm::vec2> sites;
    // A site out of sight stands for somebody who is not there.
    for (std::uint32_t row = 0; row < options_.rows; ++row)
        sites.push_back(isAlive(row, index) ? glm::vec2(position(row, index) + kToScene) : glm::vec2(1e6f));
    for (int i = 0; i < 10; ++i)
        sites.push_back(glm::vec2(glm::dvec2(-5.2, 5.2 + i) + kToScene));
    return {sites, options_.rows, glm::vec2(glm::dvec2(-16.0, -16.0) + kToScene), 128, 96, 4.0f, 0.6f};
}

void SampleCrowd::makeFrames(std::uint32_t count, const std::function<void(const Frame&)>& take) const {
    for (std::uint32_t index = 0; index < count; ++index) {
        const PerStream<std::vector<float>> values = valuesOf(index);
        Frame frame = frameOf(index, values);
        std::optional<SampleDiagram> diagram;
        if (options_.diagram_every > 0 && index % options_.diagram_every == 0)
            frame.diagram = &diagram.emplace(diagramOf(index)).image;
        take(frame);
    }
}

void SampleCrowd::writeTo(io::BakeWriter& writer, std::uint32_t count) const {
    makeFrames(count, [&](const Frame& frame) {
        writer.writeDiagram(frame);
        writer.write(frame);
    });
}

io::BakeResult SampleCrowd::bake(const std::filesystem::path& output) const {
    io::BakeWriter writer(description(output));
    writeTo(writer, options_.frames);
    return writer.finish(account(), {1.5, std::uint64_t{2} * options_.frames});
}

SampleDiagram::SampleDiagram(const std::vector<glm::vec2>& sites, std::uint32_t agent_count,
                             glm::vec2 minimum, std::uint32_t width, std::uint32_t height,
                             float pixels_per_metre, float tile_radius)
    : site(std::size_t{width} * height, kNone), distance(site.size(), 0.0f) {
    for (std::uint32_t y = 0; y < height && !sites.empty(); ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const float at_x = minimum.x + (static_cast<float>(x) + 0.5f) / pixels_per_metre;
            const float at_y = minimum.y + (static_cast<float>(y) + 0.5f) / pixels_per_metre;
            float nearest = tile_radius;
            for (std::uint32_t i = 0; i < sites.size(); ++i) {
                const float d = std::hypot(sites[i].x - at_x, sites[i].y - at_y);
                if (d >= nearest) continue;
                nearest = d;
                site[std::size_t{y} * width + x] = i;
                distance[std::size_t{y} * width + x] = d;
            }
        }
    image = {width, height, minimum, pixels_per_metre, agent_count, site, distance, {}};
}

std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "throng-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryFolder::names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
        names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
}

}  // namespace throng::test
