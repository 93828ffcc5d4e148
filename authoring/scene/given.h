// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/rebase.h"

namespace throng::authoring {

/// People whose ways are given, in the order of the ways.
std::vector<gpu::Person> givenPeople(const GivenPeople& given, const Layout& layout, const Rebase& rebase,
                                     std::uint32_t group);

/// What the device knows of all ways, once the layout's given people are the last rows of the scene.
void addWays(const Layout& layout, const Rebase& rebase, Scene& scene);

}  // namespace throng::authoring
