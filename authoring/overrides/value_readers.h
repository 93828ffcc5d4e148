// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "authoring/layout/object_reader.h"
#include "authoring/overrides/layers.h"

/// What several parts of an override file have in common. All tell what is wrong and go on.
namespace throng::authoring {

std::optional<std::uint32_t> wholeOf(const JsonNode& node, SchemaRule rule, Diagnostics& diagnostics);

/// So many numbers in an array. @param meaning for messages
std::optional<std::vector<double>> numbersOf(const JsonNode& node, SchemaRule rule, std::size_t count,
                                             const char* meaning, Diagnostics& diagnostics);

/// A pair of whole numbers, the second one not below the first. @param meaning for messages
std::optional<std::pair<std::uint32_t, std::uint32_t>> rangeOf(const JsonNode& node, SchemaRule rule,
                                                               const char* meaning, Diagnostics& diagnostics);

/// The member `frames`, if there is one.
void readFrames(ObjectReader& reader, FrameRange& frames, Diagnostics& diagnostics);

/// The member `by`, [dx, dy, dz], and the member `turn`.
void readMove(ObjectReader& reader, PersonChange& change, Diagnostics& diagnostics);

/// Who is meant: the members `id`, `group` and `spawn`.
void readPerson(ObjectReader& reader, Override& person, Diagnostics& diagnostics);
std::optional<Override> personOf(const JsonNode& node, SchemaRule rule, Diagnostics& diagnostics);

/// What overrides and layers do alike: all of a change but `hide`, `move` and whom it is about.
void readChange(ObjectReader& reader, PersonChange& change, Diagnostics& diagnostics);

}  // namespace throng::authoring
