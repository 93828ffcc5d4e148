// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/event_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "authoring/layout/goal_reader.h"
#include "authoring/layout/plan.h"

namespace throng::authoring {

void EventReader::read(const JsonNode& node) {
    Event event;
    event.where = node.where;
    ObjectReader reader(node, schema_.definition("event"), "an event", diagnostics_);
    if (!reader.isObject()) return;
    reader.require("at", "when, in seconds");
    reader.number("at", event.at);
    const std::vector<std::string> kinds = {"open", "close", "go_to", "flow"};
    const JsonNode* what = nullptr;
    int found = 0;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const JsonNode* key = reader.get(kinds[i]);
        if (!key) continue;
        ++found;
        what = key;
        event.kind = static_cast<Event::Kind>(i);
    }
    if (found != 1) {
        diagnostics_.error(node.where, "an event needs exactly one of `open`, `close`, `go_to` and `flow`");
        return;
    }
    if (event.kind == Event::Kind::go_to) readSending(reader, *what, event);
    if (event.kind == Event::Kind::rate) {
        reader.require("rate", "people per second from now on");
        reader.number("rate", event.rate);
    }
    reader.finish();
    if (event.kind != Event::Kind::go_to && !findSubject(*what, event)) return;
    if (event.kind != Event::Kind::go_to || !event.then.to.places.empty())
        layout_.events.push_back(std::move(event));
}

void EventReader::readSending(ObjectReader& reader, const JsonNode& to, Event& event) {
    Arrival arrival = Arrival::leave;
    readArrival(reader, arrival);
    if (auto destination = places_.destination(to)) event.then = goalState(*destination, arrival);
    eachOf(reader, "who", [&](const JsonNode& item) {
        if (item.kind == JsonNode::Kind::text && seats_.hasBlock(item.text))
            diagnostics_.error(item.where,
                               fmt::format("`{}` is a block of seats: its people keep them", item.text),
                               "what they do is told under `shows`");
        else if (item.kind == JsonNode::Kind::text && given_.has(item.text))
            diagnostics_.error(item.where, fmt::format("`{}` are people whose ways are given", item.text),
                               "nothing sends them elsewhere");
        else if (item.kind == JsonNode::Kind::text && groups_.count(item.text))
            event.who.push_back(item.text);
        else
            diagnostics_.error(item.where, fmt::format("there is no flow or formation `{}`", item.text),
                               hintFor(item.text, namesOfSent()));
    });
}

/// Whom an event can send somewhere.
std::vector<std::string> EventReader::namesOfSent() const {
    std::vector<std::string> names = namesOf(groups_);
    std::erase_if(names, [&](const std::string& name) { return seats_.hasBlock(name) || given_.has(name); });
    return names;
}

std::vector<std::string> EventReader::namesOfFlows() const {
    std::vector<std::string> names;
    for (const Flow& flow : layout_.flows)
        names.push_back(flow.id);
    return names;
}

bool EventReader::findSubject(const JsonNode& node, Event& event) {
    const bool is_flow = event.kind == Event::Kind::rate;
    const auto& ids = is_flow ? groups_ : walls_;
    const auto found = ids.find(node.text);
    if (node.kind != JsonNode::Kind::text || found == ids.end()) {
        diagnostics_.error(node.where,
                           fmt::format("there is no {} `{}`", is_flow ? "flow" : "wall", node.text),
                           hintFor(node.text, is_flow ? namesOfFlows() : namesOf(ids)));
        return false;
    }
    event.subject = found->second;
    if (is_flow && (event.subject >= layout_.flows.size() || layout_.flows[event.subject].id != node.text ||
                    !layout_.flows[event.subject].rate)) {
        diagnostics_.error(node.where, fmt::format("`{}` is no flow with a `rate`", node.text),
                           "only these can change");
        return false;
    }
    return true;
}

void EventReader::sort() {
    std::stable_sort(layout_.events.begin(), layout_.events.end(),
                     [](const Event& a, const Event& b) { return a.at < b.at; });
    for (const Event& event : layout_.events) {
        if (event.kind != Event::Kind::open && event.kind != Event::Kind::close) continue;
        Wall& wall = layout_.walls[event.subject];
        if (wall.closed)
            diagnostics_.error(event.where, fmt::format("wall `{}` is a solid, not a gate", wall.id),
                               "only walls without `closed` can open");
        const bool opens = event.kind == Event::Kind::open;
        if (wall.toggles.empty())
            wall.open_at_start = !opens;
        else if (wall.isOpen(wall.toggles.back()) == opens)
            diagnostics_.error(event.where,
                               fmt::format("wall `{}` already is {}", wall.id, opens ? "open" : "closed"));
        wall.toggles.push_back(event.at);
    }
}

}  // namespace throng::authoring
