// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/rebase.h"

namespace throng::authoring {

/// Warns of people who are faster than people are: units or frame rates are wrong then.
void tellOfFastWays(const Layout& layout, Diagnostics& diagnostics);

/// The people of one of the layout's groups of given people, in the order of the ways.
/// @param layout in the plane, where there are charts
/// @param group of the scene
std::vector<gpu::Person> givenPeople(const Layout& layout, std::size_t index, const Charts* charts,
                                     const Rebase& rebase, std::uint32_t group);

/// What the device knows of all ways, once the layout's given people are the last rows of the scene.
void addWays(const Layout& layout, const Rebase& rebase, Scene& scene);

}  // namespace throng::authoring
