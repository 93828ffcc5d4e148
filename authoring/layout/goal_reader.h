// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/behaviour_reader.h"
#include "authoring/layout/object_reader.h"

// What flows, formations and events say alike of where people go.
namespace throng::authoring {

/// A line of two points. @param blamed for what is amiss
std::optional<Line> lineOf(ObjectReader& reader, const std::string& key, const JsonNode& blamed,
                           Diagnostics& diagnostics);

/// What becomes of those who arrive.
void readArrival(ObjectReader& reader, Arrival& arrival);

/// Whether a goal is a seat.
bool sits(const JsonNode& node, const char* key);
/// The behaviour of those who go to a seat. @param instead what has no meaning then; @param owner an id
std::optional<std::size_t> seatsFor(BehaviourReader& behaviours, ObjectReader& reader, const JsonNode& node,
                                    const char* key, const std::vector<std::string>& instead,
                                    const std::string& owner, Diagnostics& diagnostics);

}  // namespace throng::authoring
