// SPDX-License-Identifier: Apache-2.0
#include "authoring/layout/goal_reader.h"

#include <fmt/format.h>

namespace throng::authoring {

std::optional<Line> lineOf(ObjectReader& reader, const std::string& key, const JsonNode& blamed,
                           Diagnostics& diagnostics) {
    const std::vector<glm::dvec2> points = reader.points(key);
    if (points.size() == 2) return Line{points[0], points[1]};
    if (points.size() > 2) diagnostics.error(blamed.where, fmt::format("`{}` is a line of two points", key));
    return std::nullopt;
}

void readArrival(ObjectReader& reader, Arrival& arrival) {
    reader.choice("arrival", {{"leave", Arrival::leave}, {"stay", Arrival::stay}}, arrival);
}

bool sits(const JsonNode& node, const char* key) {
    const JsonNode* goal = node.find(key);
    return goal && goal->kind == JsonNode::Kind::object && goal->find("seats");
}

std::optional<std::size_t> seatsFor(BehaviourReader& behaviours, ObjectReader& reader, const JsonNode& node,
                                    const char* key, const std::vector<std::string>& instead,
                                    const std::string& owner, Diagnostics& diagnostics) {
    refuseKeys(node, instead, "who goes to a seat stays there: `{}` has no meaning",
               "leave `{}` out, or write a behaviour", diagnostics);
    if (node.find("behaviour")) behaviours.refuseBeside(node, {key});
    if (node.find("board")) return std::nullopt;
    return behaviours.sittingIn(*reader.get(key), owner);
}

}  // namespace throng::authoring
