// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "sim/diagram/cost_model.h"
#include "sim/gl/context.h"

namespace throng::cli {

/// What `throng calibrate` measured stays in the user's cache folder, one file for each device and driver.
std::filesystem::path calibrationPath(const gl::Device& device);

/// @throws OutputError
void saveCalibration(const gl::Device& device, const sim::CostModel& model);

/// Nothing where the device has not been calibrated with this driver and version of Throng. A file that
/// cannot be understood counts as none, with a line on stderr: a cache must never stop a bake.
std::optional<sim::CostModel> loadCalibration(const gl::Device& device);

/// The calibration of the device, or the built-in table.
sim::CostModel costsFor(const gl::Device& device);

}  // namespace throng::cli
