// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "authoring/layout.h"
#include "authoring/layout/object_reader.h"

namespace throng::authoring {

/// The member `key` of an object: a number, or a distribution of numbers within the schema's limits.
/// @param standard what holds where nothing is written
Distribution readDistribution(ObjectReader& owner, const std::string& key, const Distribution& standard,
                              Diagnostics& diagnostics);

/// The member `people` of a flow or formation; adults where there is none.
People readPeople(ObjectReader& owner, Diagnostics& diagnostics);

}  // namespace throng::authoring
