// SPDX-License-Identifier: Apache-2.0
#include "authoring/family/generators.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "authoring/family/generate.h"
#include "authoring/scene/random.h"

namespace throng::authoring {
namespace {

constexpr GeneratorParameter kSeed{
    "seed", 1, 0, 9007199254740992.0, true, "of the layout's shape and of the people in it"};
constexpr GeneratorParameter kDuration{"duration", 30, 0.1, 86400, false, "s, length of the shot"};
constexpr GeneratorParameter kWarmup{"warmup", 0, 0, 3600, false, "s, simulated before the first frame"};

constexpr GeneratorParameter kCrossing[] = {
    {"arms", 4, 3, 8, true, "streets that meet"},
    {"width", 8, 2, 40, false, "m, of each street"},
    {"length", 30, 10, 500, false, "m, of each arm; longer where narrow angles need it"},
    {"irregularity", 0, 0, 1, false, "0: equal angles; 1: as uneven as people can still turn"},
    {"rate", 1, 0.01, 50, false, "persons/s into each arm"},
    kDuration,
    kWarmup,
    kSeed};
constexpr GeneratorParameter kCorridor[] = {
    {"length", 40, 10, 1000, false, "m"},
    {"width", 4, 1.2, 100, false, "m, between the walls"},
    {"forth", 1, 0, 50, false, "persons/s eastwards"},
    {"back", 1, 0, 50, false, "persons/s westwards"},
    {"pillars", 0, 0, 200, true, "at most so many, as far as they leave room to pass"},
    {"pillar_radius", 0.3, 0.1, 2, false, "m"},
    kDuration,
    kWarmup,
    kSeed};
constexpr GeneratorParameter kStreets[] = {
    {"columns", 3, 1, 12, true, "blocks from west to east"},
    {"rows", 2, 1, 12, true, "blocks from south to north"},
    {"block", 25, 8, 200, false, "m, side of a block; they vary by a quarter"},
    {"width", 7, 2, 40, false, "m, of the streets"},
    {"rate", 2, 0.01, 200, false, "persons/s in all, from every end of a street to every other"},
    kDuration,
    kWarmup,
    kSeed};
constexpr GeneratorParameter kMarathon[] = {
    {"people", 1000, 1, 2000000, true, "who stand in a field before the town and run through it"},
    {"spacing", 1.2, 0.9, 5, false, "m between them"},
    {"columns", 3, 1, 12, true, "blocks from the field to the finish; the town is as wide as the field"},
    {"block", 40, 8, 200, false, "m, side of a block; they vary by a quarter"},
    {"width", 12, 3, 40, false, "m, of the streets"},
    {"waves", 1, 1, 50, true, "in which they set off, the first lines first"},
    {"interval", 10, 0, 600, false, "s between two waves"},
    kDuration,
    kSeed};
constexpr GeneratorParameter kPlaza[] = {
    {"size", 30, 10, 300, false, "m, across"},
    {"exits", 4, 2, 8, true, "openings, evenly round it"},
    {"exit_width", 3, 1, 10, false, "m; narrower where a side is too short"},
    {"pillars", 12, 0, 400, true, "at most so many, as far as they leave room to pass"},
    {"pillar_radius", 0.4, 0.1, 3, false, "m"},
    {"rate", 2, 0.01, 200, false, "persons/s in all, from every opening to every other"},
    kDuration,
    kWarmup,
    kSeed};
constexpr GeneratorParameter kStadium[] = {
    {"radius", 30, 12, 300, false, "m, of the pitch and what is round it, where nobody walks"},
    {"stand", 12, 4, 60, false, "m, depth of the ring in which people sit"},
    {"exits", 6, 1, 24, true, "gates in the outer wall, evenly round it"},
    {"exit_width", 3, 1, 10, false, "m"},
    {"people", 500, 1, 100000, true, "who leave; at most 2 per square metre of the stand"},
    {"rise", 10, 0, 600, false, "s, over which people rise from their seats"},
    {"stands", 0, 0, 12, true,
     "blocks of seats that are left by openings to a concourse behind, two at least; at most 45 m to the "
     "first "
     "row, 16 rows and 40000 people then; 0: a ring of ground"},
    kDuration,
    kSeed};
constexpr GeneratorParameter kStation[] = {
    {"platforms", 2, 1, 5, true, "over a concourse"},
    {"length", 90, 90, 200, false, "m, of each"},
    {"platform_width", 8, 5, 12, false, "m; wide enough for the stairs and a way round them at least"},
    {"stairs", 3, 1.2, 6, false, "m, width of the two stairs to each platform"},
    {"escalators", 1, 0, 1, true, "1: one up and one down for each platform"},
    {"people", 400, 1, 20000, true, "half of whom come out of trains; the others go to them"},
    {"time", 30, 0, 3600, false, "s, in which they come"},
    kDuration,
    kSeed};
constexpr GeneratorParameter kOffice[] = {
    {"floors", 3, 1, 8, true, "above each other"},
    {"rooms", 6, 1, 12, true, "on either side of the corridor, on each floor"},
    {"room", 4, 3, 8, false, "m, width and depth of a room"},
    {"corridor", 2, 1.4, 4, false, "m, its width"},
    {"stairs", 1.4, 1.2, 3, false, "m, width of the stairs at both ends"},
    {"people", 40, 1, 1000, true, "on each floor, who leave; at most 1 per square metre of the rooms"},
    {"rise", 10, 0, 600, false, "s, over which they set off"},
    kDuration,
    kSeed};

constexpr Generator kGenerators[] = {
    {"crossing", "streets that meet in one place, walls on the corners", kCrossing, generate::crossing},
    {"corridor", "two streams between two walls, pillars if wanted", kCorridor, generate::corridor},
    {"streets", "a grid of streets between blocks", kStreets, generate::streets},
    {"marathon", "people run from a field through all streets of a town", kMarathon, generate::marathon},
    {"plaza", "a walled square with openings and random pillars", kPlaza, generate::plaza},
    {"stadium", "people leave a ring of seats by gates in the outer wall", kStadium, generate::stadium},
    {"station", "platforms over a concourse, with stairs and escalators", kStation, generate::station},
    {"office", "people leave the rooms of several floors by stairs at both ends", kOffice, generate::office},
};

}  // namespace

GeneratorValues::GeneratorValues(std::span<const GeneratorParameter> parameters) : parameters_(parameters) {
    for (const GeneratorParameter& parameter : parameters)
        values_.push_back(parameter.standard);
}

std::size_t GeneratorValues::indexOf(std::string_view name) const {
    std::string known;
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
        if (parameters_[i].name == name) return i;
        known += fmt::format("{}{}", i ? ", " : "", parameters_[i].name);
    }
    throw std::invalid_argument(fmt::format("there is no parameter `{}`; there are: {}", name, known));
}

double GeneratorValues::operator[](std::string_view name) const {
    return values_[indexOf(name)];
}

std::uint64_t GeneratorValues::whole(std::string_view name) const {
    return static_cast<std::uint64_t>(values_[indexOf(name)]);
}

void GeneratorValues::set(std::string_view name, double value) {
    const std::size_t index = indexOf(name);
    const GeneratorParameter& parameter = parameters_[index];
    if (!(value >= parameter.least && value <= parameter.most) ||
        (parameter.whole && value != std::floor(value)))
        throw std::invalid_argument(fmt::format("`{}` is a{} number from {:.16g} to {:.16g}, not {:.16g}",
                                                name, parameter.whole ? " whole" : "", parameter.least,
                                                parameter.most, value));
    values_[index] = value;
}

std::span<const Generator> generators() {
    return kGenerators;
}

const Generator* generatorNamed(std::string_view name) {
    const auto* found = std::find_if(std::begin(kGenerators), std::end(kGenerators),
                                     [&](const Generator& generator) { return generator.name == name; });
    return found == std::end(kGenerators) ? nullptr : found;
}

namespace generate {

Json frameOf(const std::string& name, const GeneratorValues& values) {
    Json layout;
    layout["throng"] = 1;
    layout["name"] = name;
    layout["simulation"] = {{"duration", values["duration"]}, {"seed", values.whole("seed")}};
    for (const GeneratorParameter& parameter : values.parameters())
        if (parameter.name == "warmup" && values["warmup"] > 0.0)
            layout["simulation"]["warmup"] = values["warmup"];
    return layout;
}

std::vector<glm::dvec2> scatter(std::size_t count, glm::dvec2 minimum, glm::dvec2 maximum, double gap,
                                std::uint64_t seed, bool (*fits)(glm::dvec2, const void*),
                                const void* context) {
    const GroupRandom random(seed, "pillars");
    std::vector<glm::dvec2> placed;
    constexpr std::uint64_t kTriesEach = 30;
    for (std::uint64_t attempt = 0; attempt < kTriesEach * count && placed.size() < count; ++attempt) {
        const glm::dvec2 at(minimum.x + (maximum.x - minimum.x) * random.unit(attempt, Purpose::goal_x),
                            minimum.y + (maximum.y - minimum.y) * random.unit(attempt, Purpose::goal_y));
        const bool free = std::all_of(placed.begin(), placed.end(), [&](glm::dvec2 other) {
            return std::hypot(at.x - other.x, at.y - other.y) >= gap;
        });
        if (free && fits(at, context)) placed.push_back(at);
    }
    return placed;
}

void addPillars(Json& layout, const std::vector<glm::dvec2>& centres, double radius) {
    constexpr int kSides = 8;
    for (std::size_t i = 0; i < centres.size(); ++i) {
        std::vector<glm::dvec2> outline;
        for (int side = 0; side < kSides; ++side) {
            const double angle = 2.0 * std::numbers::pi * side / kSides;
            outline.push_back(centres[i] + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        layout["walls"].push_back(
            {{"id", fmt::format("pillar {}", i + 1)}, {"closed", true}, {"points", points(outline)}});
    }
}

}  // namespace generate
}  // namespace throng::authoring
