// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/rebase.h"

namespace throng::authoring {

/// Tells of given people in a layout whose levels are grounds of a terrain, which are not cut for them.
bool isWithoutGivenPeople(const Layout& layout, Diagnostics& diagnostics);

/// Warns of people who are faster than people are: units or frame rates are wrong then.
void tellOfFastWays(const Layout& layout, Diagnostics& diagnostics);

/// People whose ways are given, in the order of the ways.
std::vector<gpu::Person> givenPeople(const GivenPeople& given, const Layout& layout, const Rebase& rebase,
                                     std::uint32_t group);

/// What the device knows of all ways, once the layout's given people are the last rows of the scene.
void addWays(const Layout& layout, const Rebase& rebase, Scene& scene);

}  // namespace throng::authoring
