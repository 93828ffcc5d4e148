// SPDX-License-Identifier: Apache-2.0
#include "io/overrides/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>

#include "base/plane_grid.h"
#include "base/polygon.h"
#include "base/random.h"
#include "io/overrides/camera_view.h"
#include "io/overrides/flat_shapes.h"

namespace throng::io {
namespace {

using authoring::Combined;
using authoring::Named;

constexpr double kTall = 1.8;  // m, of who is not scaled

const char* columnOf(Named::Of of) {
    return of == Named::Of::group ? "group" : of == Named::Of::profile ? "profile" : "look";
}

}  // namespace

void Selection::remark(std::string text) {
    if (std::ranges::find(remarks_, text) == remarks_.end()) remarks_.push_back(std::move(text));
}

std::vector<bool> Selection::whom(const authoring::Selector& selector) {
    return std::visit([this](const auto& what) { return meant(what); }, selector.what);
}

template <class Visit>
void Selection::eachFrame(const authoring::FrameRange& frames, Visit&& visit) {
    std::vector<PersonPlace> places;
    if (frames.first >= crowd_.frames())
        remark(fmt::format("the bake has no frame {}: it has {}", frames.first, crowd_.frames()));
    for (std::uint32_t frame = frames.first; frame < crowd_.frames() && frames.holds(frame); ++frame) {
        crowd_.places(frame, places);
        visit(frame, places);
    }
}

template <class Test>
std::vector<bool> Selection::whoEver(const authoring::FrameRange& frames, Test&& test) {
    Chosen chosen(crowd_.rows());
    eachFrame(frames, [&](std::uint32_t frame, const std::vector<PersonPlace>& places) {
        for (std::uint32_t row = 0; row < places.size(); ++row)
            if (!chosen[row] && places[row].is_there) chosen[row] = test(frame, row, places[row].place);
    });
    return chosen;
}

std::vector<bool> Selection::meant(const authoring::Changed&) {
    Chosen chosen(crowd_.rows());
    for (std::uint32_t row = 0; row < crowd_.rows(); ++row)
        chosen[row] = crowd_.plan(row).isChanged();
    return chosen;
}

std::vector<bool> Selection::meant(const Named& named) {
    Chosen chosen(crowd_.rows());
    std::set<std::string> missing(named.names.begin(), named.names.end());
    const bool by_copy = named.of == Named::Of::copies;
    if (!by_copy && !crowd_.table().has(columnOf(named.of)))
        remark(fmt::format("this bake's agents.csv has no column `{}`", columnOf(named.of)));
    else
        for (std::uint32_t row = 0; row < crowd_.rows(); ++row) {
            const std::string& word =
                by_copy ? crowd_.plan(row).copy_of : crowd_.table().at(row, columnOf(named.of));
            chosen[row] = std::ranges::find(named.names, word) != named.names.end();
            if (chosen[row]) missing.erase(word);
        }
    for (const std::string& name : missing)
        remark(by_copy ? fmt::format("there are no copies of the layer `{}`", name)
                       : fmt::format("there is no {} `{}` in this bake", columnOf(named.of), name));
    return chosen;
}

std::vector<std::uint32_t> Selection::parties() const {
    std::vector<std::uint32_t> parties(crowd_.rows());
    for (std::uint32_t row = 0; row < crowd_.rows(); ++row)
        parties[row] = crowd_.table().has("party") ? crowd_.table().frame(row, "party").value_or(row) : row;
    return parties;
}

std::vector<bool> Selection::meant(const authoring::PartySize& size) {
    const std::vector<std::uint32_t> party = parties();
    std::map<std::uint32_t, std::uint32_t> counts;
    for (const std::uint32_t each : party)
        ++counts[each];
    Chosen chosen(crowd_.rows());
    for (std::uint32_t row = 0; row < crowd_.rows(); ++row)
        chosen[row] = counts[party[row]] >= size.least && counts[party[row]] <= size.most;
    return chosen;
}

std::vector<bool> Selection::company(const authoring::Selector& of) {
    const std::vector<std::uint32_t> party = parties();
    Chosen chosen = whom(of);
    std::set<std::uint32_t> meant;
    for (std::uint32_t row = 0; row < crowd_.rows(); ++row)
        if (chosen[row]) meant.insert(party[row]);
    for (std::uint32_t row = 0; row < crowd_.rows(); ++row)
        chosen[row] = meant.contains(party[row]);
    return chosen;
}

std::vector<bool> Selection::meant(const authoring::Rows& rows) {
    Chosen chosen(crowd_.rows());
    for (std::uint32_t row = rows.first; row < crowd_.rows() && row <= rows.last; ++row)
        chosen[row] = true;
    if (rows.first >= crowd_.rows())
        remark(fmt::format("there is no row {}: this bake has {} people", rows.first, crowd_.rows()));
    return chosen;
}

std::vector<bool> Selection::meant(const authoring::ListedPeople& people) {
    Chosen chosen(crowd_.rows());
    const std::vector<authoring::Match> matches = authoring::matchOverrides(people.people, entrants_);
    for (std::size_t i = 0; i < matches.size(); ++i)
        if (matches[i].kind == authoring::Match::Kind::orphaned)
            remark(fmt::format("person {} of `{}`: {}", people.people[i].id, people.people[i].group,
                               authoring::orphanReason(people.people[i], entrants_)));
        else
            chosen[matches[i].row] = true;
    return chosen;
}

std::optional<std::uint32_t> Selection::rowOf(const authoring::Override& person) const {
    const authoring::Match match = authoring::matchOverrides(std::span(&person, 1), entrants_).front();
    if (match.kind == authoring::Match::Kind::orphaned) return std::nullopt;
    return match.row;
}

std::vector<bool> Selection::meant(const authoring::Region& region) {
    std::vector<glm::dvec2> polygon = region.polygon;
    for (glm::dvec2& point : polygon)
        point -= crowd_.bake().origin;
    return whoEver(region.frames, [&](std::uint32_t, std::uint32_t, glm::dvec3 place) {
        return isWithin(polygon, glm::dvec2(place));
    });
}

std::vector<bool> Selection::meant(const authoring::Share& share) {
    Chosen chosen(crowd_.rows());
    for (std::uint32_t row = 0; row < crowd_.rows(); ++row) {
        const std::uint64_t word = scramble(crowd_.plan(row).identity ^ scramble(share.seed + 1));
        chosen[row] = fractionOf(word) < share.of;
    }
    return chosen;
}

std::vector<bool> Selection::meant(const authoring::Seen& seen) {
    const glm::dvec3 origin(crowd_.bake().origin,
                            crowd_.bake().manifest.value("/origin/2"_json_pointer, 0.0));
    std::vector<CameraView> views;
    for (const authoring::View& view : seen.views)
        views.emplace_back(view, origin, seen.margin, seen.range);
    return whoEver(seen.frames, [&](std::uint32_t frame, std::uint32_t row, glm::dvec3 place) {
        const auto next = std::ranges::upper_bound(seen.views, frame, {}, &authoring::View::frame);
        const auto index = std::max<std::ptrdiff_t>(next - seen.views.begin() - 1, 0);
        return views[static_cast<std::size_t>(index)].sees(place, kTall * crowd_.scaleOf(row));
    });
}

std::vector<bool> Selection::meant(const authoring::Near& near) {
    if (!near.who.empty()) return nearOthers(near);
    if (!near.wall.empty()) return nearWall(near);
    const glm::dvec2 point = near.point.value_or(glm::dvec2(0.0)) - crowd_.bake().origin;
    return whoEver(near.frames, [&](std::uint32_t, std::uint32_t, glm::dvec3 place) {
        return glm::distance(glm::dvec2(place), point) <= near.within;
    });
}

std::vector<bool> Selection::nearWall(const authoring::Near& near) {
    const auto& walls = crowd_.bake().walls;
    const auto wall = std::ranges::find(walls, near.wall, &authoring::Wall::id);
    if (wall == walls.end()) {
        remark(fmt::format("there is no wall `{}` in this bake", near.wall));
        return Chosen(crowd_.rows());
    }
    return whoEver(near.frames, [&](std::uint32_t, std::uint32_t, glm::dvec3 place) {
        return distanceToWall(*wall, glm::dvec2(place)) <= near.within;
    });
}

std::vector<bool> Selection::nearOthers(const authoring::Near& near) {
    const Chosen others = whom(near.who.front());
    Chosen chosen(crowd_.rows());
    const double cell = std::clamp(near.within, 0.5, 50.0);
    PlaneGrid grid(crowd_.bake().minimum, crowd_.bake().maximum, cell, cellsFor(crowd_.rows()));
    eachFrame(near.frames, [&](std::uint32_t, const std::vector<PersonPlace>& places) {
        std::vector<glm::dvec2> there;
        std::vector<std::uint32_t> rows;
        for (std::uint32_t row = 0; row < places.size(); ++row) {
            if (!others[row] || !places[row].is_there) continue;
            there.emplace_back(places[row].place);
            rows.push_back(row);
        }
        grid.sort(there);
        for (std::uint32_t row = 0; row < places.size(); ++row) {
            if (chosen[row] || !places[row].is_there) continue;
            const glm::dvec2 place(places[row].place);
            grid.near(place, near.within, [&](std::uint32_t i) {
                if (rows[i] != row && glm::distance(there[i], place) <= near.within) chosen[row] = true;
            });
        }
    });
    return chosen;
}

std::vector<bool> Selection::meant(const Combined& combined) {
    if (combined.by == Combined::By::company) return company(combined.parts.front());
    const bool all = combined.by == Combined::By::all;
    Chosen chosen(crowd_.rows(), all);
    for (const authoring::Selector& part : combined.parts) {
        const Chosen each = whom(part);
        for (std::uint32_t row = 0; row < crowd_.rows(); ++row)
            chosen[row] = all ? chosen[row] && each[row] : chosen[row] || each[row];
    }
    if (combined.by == Combined::By::none) chosen.flip();
    return chosen;
}

}  // namespace throng::io
