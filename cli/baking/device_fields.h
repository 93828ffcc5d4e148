// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "authoring/scene/fields.h"

namespace throng::cli {

/// Where distance fields are solved.
enum class FieldsBy {
    automatic,  ///< on the device if that is a real one: a software renderer would only take longer
    cpu,
    device,
};

/// A solver on the device, in a context of its own that goes with it, or null where fields are the CPU's
/// business.
/// @param device as gl::Context::Options::device; @param shader_dir empty for the shaders in the binary
/// @throws gl::GraphicsError
std::unique_ptr<authoring::DistanceSolver> makeDeviceFields(FieldsBy by, int device,
                                                            const std::string& shader_dir);

}  // namespace throng::cli
