// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>

#include "authoring/overrides/layers.h"

namespace throng::io {

/// What a camera sees at one moment, whatever stands before it.
class CameraView {
  public:
    /// @param origin m, of the places that are asked for
    CameraView(const authoring::View& view, glm::dvec3 origin, double margin, double range);

    /// Whether anything of a line from the feet to the head of somebody is in the picture, or near enough.
    bool sees(glm::dvec3 feet, double height) const;

  private:
    glm::dmat4 to_camera_;
    glm::dvec2 size_, shift_;
    bool parallel_;
    double margin_, range_;
};

}  // namespace throng::io
