// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/seat_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "authoring/layout/people_reader.h"
#include "authoring/layout/row_line.h"
#include "authoring/layout/seat_mouths.h"
#include "authoring/layout/seat_rows.h"

namespace throng::authoring {
namespace {

constexpr double kStandHeight = 0.01;  // m, of the outline: what is seen of a stand are its rows
constexpr double kWholeRound = 360.0;

BehaviourState sittingIn(const SeatBlock& block) {
    BehaviourState state;
    state.id = "sit";
    state.does = BehaviourState::Does::sit;
    state.activity = ActivityCode::sits;
    state.blocks = {{block.id, block.where}};
    state.where = block.where;
    return state;
}

}  // namespace

void SeatReader::readBlock(const JsonNode& node) {
    SeatBlock block;
    block.where = node.where;
    ObjectReader reader(node, schema_.definition("seat_block"), "a block of seats", diagnostics_);
    if (!reader.isObject()) return;
    reader.requiredText("id", "its name, for shows and in the account", block.id);
    const JsonNode* front = reader.get("front");
    const JsonNode* arc = reader.get("arc");
    if ((front != nullptr) == (arc != nullptr))
        diagnostics_.error(
            node.where,
            fmt::format("a block of seats needs exactly one of `front` (the first row's points) "
                        "and `arc` (part of a circle), this one has {}",
                        front ? "both" : "neither"),
            R"(for example "front": [[0, 0], [10, 0]])");
    if (front) block.front = reader.points("front");
    if (arc) readArc(reader, *arc, block);
    reader.integer("rows", block.rows);
    reader.number("pitch", block.pitch);
    reader.number("width", block.width);
    reader.number("rise", block.rise);
    reader.number("height", block.height);
    reader.point("facing", block.facing);
    reader.integer("aisles", block.aisles);
    reader.number("aisle_width", block.aisle_width);
    reader.number("occupancy", block.occupancy);
    reader.boolean("on_terrain", block.on_terrain);
    block.people = readPeople(reader, diagnostics_);
    if (const JsonNode* leave = reader.get("leave")) readLeave(*leave, block);
    if (const JsonNode* level = reader.get("level")) {
        block.level = levels_.levelNamed(*level);
        if (block.level < layout_.levels.size()) block.height += layout_.levels[block.level].height;
    }
    readMouths(reader, block);
    if (block.on_terrain) checkOnTerrain(*node.find("on_terrain"), block);
    reader.finish();
    claimId(node, block.id, blocks_, layout_.seats.size(), "a block of seats", diagnostics_);
    claimId(node, block.id, groups_, std::string::npos, "a flow, formation or block of seats", diagnostics_);
    if (block.front.size() >= 2 && !diagnostics_.hasErrors()) {
        checkBlock(block, node);
        if (!diagnostics_.hasErrors()) addStands(block);
    }
    layout_.seats.push_back(std::move(block));
}

void SeatReader::checkOnTerrain(const JsonNode& node, const SeatBlock& block) const {
    if (!layout_.terrain)
        diagnostics_.error(node.where, "there is no terrain that the block could go up and down with",
                           "leave it out, or give the layout a `terrain`");
    if (hasPassages(block))
        diagnostics_.error(node.where,
                           fmt::format("block `{}` has passages: these are of level stands only", block.id),
                           "leave out its `mouths`, so that aisles go out before it, or `on_terrain`");
}

/// Where its aisles go out.
void SeatReader::readMouths(ObjectReader& reader, SeatBlock& block) const {
    using At = SeatBlock::Mouths::At;
    SeatBlock::Mouths& mouths = block.mouths;
    mouths.level = block.level;
    if (const JsonNode* node = reader.get("mouths")) {
        mouths.where = node->where;
        ObjectReader told(*node, schema_.definition("seat_block").property("mouths"), "`mouths`",
                          diagnostics_);
        if (!told.isObject()) return;
        told.choice("at", {{"front", At::front}, {"back", At::back}, {"row", At::row}}, mouths.at);
        if (mouths.at == At::row) told.require("row", "on which people come out, from 1");
        told.integer("row", mouths.row);
        told.number("passage", mouths.passage);
        mouths.level = node->find("level") ? levels_.levelOf(told) : mouths.level;
        told.finish();
        checkMouths(*node, block);
    }
    if (mouths.level < layout_.levels.size()) mouths.height = layout_.levels[mouths.level].height;
}

void SeatReader::checkMouths(const JsonNode& node, const SeatBlock& block) const {
    using At = SeatBlock::Mouths::At;
    const JsonNode* row = node.find("row");
    if (row && block.mouths.at != At::row)
        diagnostics_.error(row->where, "`row` is only of mouths at a row", R"(write "at": "row")");
    if (const JsonNode* passage = node.find("passage"); passage && block.mouths.at == At::front)
        diagnostics_.error(passage->where, "people step from the front straight onto the ground",
                           R"(leave it out, or write "at": "back" or "row")");
    if (row && block.mouths.row > block.rows)
        diagnostics_.error(row->where,
                           fmt::format("block `{}` has {} rows: its aisles cannot come out on row {}",
                                       block.id, block.rows, block.mouths.row),
                           fmt::format("rows are counted from the front, from 1 to {}", block.rows));
    if (block.mouths.at != At::front && block.aisles == 0)
        diagnostics_.error(node.where,
                           fmt::format("block `{}` has no aisles that could go out there", block.id),
                           R"(give it "aisles")");
}

/// As a behaviour: who sits there does until then.
void SeatReader::readLeave(const JsonNode& node, SeatBlock& block) {
    ObjectReader reader(node, schema_.definition("seat_block").property("leave"), "`leave`", diagnostics_);
    if (!reader.isObject()) return;
    Condition when;
    when.kind = Condition::Kind::at;
    when.where = node.where;
    reader.require("at", "when, in seconds");
    when.time = readDistribution(reader, "at", when.time, diagnostics_);
    const JsonNode* to = reader.require("to", "where people go");
    const auto destination = to ? places_.destination(*to) : std::nullopt;
    reader.finish();
    if (!destination) return;
    Behaviour behaviour{block.id, {sittingIn(block), {}}, 0, node.where};
    behaviour.states[0].until = {{{when}, 1}};
    BehaviourState& leaves = behaviour.states[1];
    leaves.id = "leave";
    leaves.does = BehaviourState::Does::walk;
    leaves.to = *destination;
    leaves.where = node.where;
    block.behaviour = layout_.behaviours.size();
    layout_.behaviours.push_back(std::move(behaviour));
}

void SeatReader::open() {
    const std::vector<Behaviour> all = layout_.behaviours;
    std::vector<bool> opens(layout_.seats.size(), false);
    for (const Behaviour& behaviour : all)
        for (const BehaviourState& state : behaviour.states)
            for (const GroupName& name : state.blocks) {
                const auto found = blocks_.find(name.id);
                if (found != blocks_.end())
                    opens[found->second] = true;
                else
                    diagnostics_.error(
                        name.where, fmt::format("there is no block of seats `{}`", name.id),
                        blocks_.empty() ? "list it under `seats`" : hintFor(name.id, namesOf(blocks_)));
            }
    if (diagnostics_.hasErrors()) return;
    for (std::size_t i = 0; i < opens.size(); ++i)
        if (opens[i]) openBlock(layout_.seats[i]);
    for (Behaviour& behaviour : layout_.behaviours)
        for (BehaviourState& state : behaviour.states)
            if (state.does == BehaviourState::Does::sit) leadTo(state);
}

/// People go to the aisles.
void SeatReader::leadTo(BehaviourState& state) const {
    state.to = {Destination::Kind::choose, {}, {}, state.where};
    for (const GroupName& name : state.blocks) {
        const std::size_t block = blocks_.at(name.id);
        for (std::size_t aisle = 0; aisle < countAisles(layout_.seats[block]); ++aisle)
            state.to.places.push_back({Place::Kind::aisle, block, name.where, aisle});
    }
    state.to.weights.assign(state.to.places.size(), 1.0);
}

/// Those who sit there are simulated, and nobody else walks through its aisles.
void SeatReader::openBlock(SeatBlock& block) {
    constexpr double kTogether = 0.5;  // m
    if (block.aisles == 0 && glm::distance(block.front.front(), block.front.back()) < kTogether)
        diagnostics_.error(block.where,
                           fmt::format("nobody gets into block `{}`: it goes all round", block.id),
                           R"(give it "aisles")");
    if (!block.behaviour) {
        block.behaviour = layout_.behaviours.size();
        layout_.behaviours.push_back({block.id, {sittingIn(block)}, 0, block.where});
        layout_.behaviours.back().states[0].for_good = true;
    }
    for (std::vector<glm::dvec2>& outline : aisleOutlines(block))
        addStand(block, std::move(outline), block.level);
    for (std::size_t aisle = 0; hasPassages(block) && aisle < countAisles(block); ++aisle)
        if (std::vector<glm::dvec2> outline = passageOutline(block, aisle); !outline.empty())
            addStand(block, std::move(outline), block.mouths.level);
}

void SeatReader::readArc(ObjectReader& reader, const JsonNode& node, SeatBlock& block) {
    ObjectReader arc(node, reader.rule("arc"), "`arc`", diagnostics_);
    if (!arc.isObject()) return;
    glm::dvec2 centre(0.0);
    arc.point("centre", "the middle, [x, y] in metres", centre);
    std::array<double, 3> numbers{1.0, 0.0, 0.0};
    constexpr std::array kNames = {std::pair{"radius", "metres"}, std::pair{"from", "degrees"},
                                   std::pair{"to", "degrees"}};
    bool complete = node.find("centre") != nullptr;
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        complete = arc.require(kNames[i].first, kNames[i].second) && complete;
        arc.number(kNames[i].first, numbers[i]);
    }
    arc.finish();
    const auto [radius, from, to] = numbers;
    if (!complete || diagnostics_.hasErrors()) return;
    if (to <= from || to - from > kWholeRound) {
        diagnostics_.error(
            node.find("to")->where,
            fmt::format("the arc goes from {:.6g} to {:.6g} degrees: counter-clockwise, at most "
                        "a whole round",
                        from, to),
            to <= from ? fmt::format("write \"to\": {:.6g}", to + kWholeRound)
                       : fmt::format("write \"to\": {:.6g}", from + kWholeRound));
        return;
    }
    block.front = arcFront(centre, radius, from, to);
    block.facing = centre;
}

void SeatReader::checkBlock(const SeatBlock& block, const JsonNode& node) const {
    if (foldsBack(block)) {
        diagnostics_.error(
            node.where,
            fmt::format("block `{}`: rows so far behind a first row that bends so sharply cross themselves",
                        block.id),
            "people look to the left of `front`: turn its points round, or take fewer rows");
        return;
    }
    if (countSeats(block) == 0)
        diagnostics_.error(node.where, fmt::format("block `{}` has room for no seat", block.id),
                           "make its first row longer, its seats or aisles narrower, or its aisles fewer");
    if (hasPassages(block)) checkPassage(block);
    if (hasPassages(block) && block.aisles > 0) checkOpenings(block);
}

/// Rows are cut beside openings, for the steps there: between two aisles there is room for both, and none
/// sticks out.
void SeatReader::checkOpenings(const SeatBlock& block) const {
    for (std::size_t row = landingRow(block); row <= lastCutRow(block); ++row) {
        const RowLine line(block, static_cast<double>(row) * block.pitch);
        const double gap = gapOfRow(block, row);
        for (std::size_t aisle = 0; aisle <= block.aisles; ++aisle) {
            const bool first = aisle == 0, last = aisle == block.aisles;
            const double room = line.lengthBetween(first ? 0.0 : aisleShare(block, aisle - 1),
                                                   last ? 1.0 : aisleShare(block, aisle));
            const double needed = (first || last ? 0.5 : 1.0) * gap;
            if (room >= needed) continue;
            diagnostics_.error(
                block.mouths.where,
                fmt::format("block `{}` has {:.2f} m of row {} {}, where its openings need {:.2f} m",
                            block.id, room, row + 1,
                            first || last ? "between its end and an aisle" : "from one aisle to the next",
                            needed),
                R"(make the row longer, "aisles" fewer or "aisle_width" narrower)");
            return;
        }
    }
}

void SeatReader::checkPassage(const SeatBlock& block) const {
    constexpr double kSteepest = 0.8;  // rise over run, as of stairs
    const double landing = block.height + static_cast<double>(landingRow(block)) * block.rise;
    const double climb = std::abs(landing - block.mouths.height), length = passageLength(block);
    if (climb > kSteepest * length)
        diagnostics_.error(
            block.mouths.where,
            fmt::format(
                "the passages of block `{}` climb {:.2f} m over {:.2f} m: they climb at most {:.0f} %",
                block.id, climb, length, 100.0 * kSteepest),
            fmt::format(R"(write "passage": {:.1f} or more, or take another row)",
                        std::ceil(10.0 * climb / kSteepest) / 10.0));
}

/// Others walk round the stand and through its aisles.
void SeatReader::addStands(const SeatBlock& block) {
    for (std::vector<glm::dvec2>& outline : standOutlines(block))
        addStand(block, std::move(outline), block.level);
}

void SeatReader::addStand(const SeatBlock& block, std::vector<glm::dvec2> outline, std::size_t level) {
    Wall wall;
    wall.id = block.id + " stand";
    while (!walls_.emplace(wall.id, layout_.walls.size()).second)
        wall.id += "_";
    wall.points = std::move(outline);
    wall.closed = true;
    wall.height = kStandHeight;
    wall.level = level;
    wall.where = block.where;
    layout_.walls.push_back(std::move(wall));
}

void SeatReader::readShow(const JsonNode& node) {
    Show show;
    show.where = node.where;
    ObjectReader reader(node, schema_.definition("show"), "a show", diagnostics_);
    if (!reader.isObject()) return;
    reader.require("at", "when, in seconds");
    show.at = readDistribution(reader, "at", show.at, diagnostics_);
    reader.require("do", "clap, cheer, sing or wave");
    reader.choice("do",
                  {{"clap", Show::Kind::clap},
                   {"cheer", Show::Kind::cheer},
                   {"sing", Show::Kind::sing},
                   {"wave", Show::Kind::wave}},
                  show.kind);
    readAudience(reader.get("who"), show);
    reader.number("share", show.share);
    show.lasts = readDistribution(reader, "for", show.lasts, diagnostics_);
    show.reaction = readDistribution(reader, "reaction", show.reaction, diagnostics_);
    readWave(reader, node, show);
    reader.finish();
    layout_.shows.push_back(std::move(show));
}

void SeatReader::readAudience(const JsonNode* list, Show& show) const {
    const std::vector<std::string> known = namesOf(blocks_);
    if (known.empty() && !diagnostics_.hasErrors())
        diagnostics_.error(show.where, "there is no audience: this layout has no seats",
                           "list blocks of seats under `seats`");
    if (!list) {
        show.blocks.resize(layout_.seats.size());
        std::iota(show.blocks.begin(), show.blocks.end(), std::size_t{0});
        return;
    }
    if (list->kind != JsonNode::Kind::array || list->items.empty()) {
        diagnostics_.error(list->where, "expected a list of ids of blocks of seats",
                           R"(for example "who": ["north", "west"])");
        return;
    }
    for (const JsonNode& item : list->items) {
        const auto found = blocks_.find(item.text);
        if (item.kind != JsonNode::Kind::text || found == blocks_.end())
            diagnostics_.error(item.where, fmt::format("there is no block of seats `{}`", item.text),
                               known.empty() ? "list it under `seats`" : hintFor(item.text, known));
        else if (std::ranges::find(show.blocks, found->second) != show.blocks.end())
            diagnostics_.error(item.where, fmt::format("block `{}` is named twice", item.text));
        else
            show.blocks.push_back(found->second);
    }
}

void SeatReader::readWave(ObjectReader& reader, const JsonNode& node, Show& show) const {
    reader.number("speed", show.speed);
    reader.number("width", show.width);
    reader.point("from", show.from);
    reader.integer("laps", show.laps);
    const bool is_wave = show.kind == Show::Kind::wave;
    const std::array wrong =
        is_wave ? std::array{"for", "for", "for", "for"} : std::array{"speed", "width", "from", "laps"};
    for (std::size_t i = 0; i < (is_wave ? 1 : wrong.size()); ++i)
        if (const JsonNode* key = node.find(wrong[i]))
            diagnostics_.error(key->where,
                               fmt::format("`{}` is {} a wave", wrong[i], is_wave ? "not of" : "only of"),
                               is_wave ? "a wave is as long as it takes to run round"
                                       : R"(write "do": "wave", or leave it out)");
}

}  // namespace throng::authoring
