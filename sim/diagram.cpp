// SPDX-License-Identifier: Apache-2.0
#include "sim/diagram.h"

#include <fmt/format.h>

#include "sim/diagram_methods.h"
#include "sim/gl/context.h"

namespace throng::sim {

Diagram::Diagram(const gl::ShaderLibrary& library, Method method, std::uint32_t width, std::uint32_t height,
                 float largest_radius, std::span<const gpu::DiagramSite> fixed_sites) {
    const DiagramWindow window{width, height, largest_radius};
    if (method == Method::per_site)
        implementation_ = std::make_unique<PerSiteDiagram>(library, window, fixed_sites);
    else
        implementation_ = std::make_unique<GradientDiagram>(library, window);
}

Diagram::~Diagram() = default;
Diagram::Diagram(Diagram&&) noexcept = default;
Diagram& Diagram::operator=(Diagram&&) noexcept = default;

void Diagram::connect(const Input& input) {
    implementation_->connect(input);
}
void Diagram::build() {
    implementation_->build(false);
}
void Diagram::buildWithDistances() {
    implementation_->build(true);
}
const gl::Buffer& Diagram::owners() const {
    return implementation_->owners;
}
const gl::Buffer& Diagram::distances() const {
    return implementation_->distances;
}
float Diagram::distanceScale() const {
    return implementation_->distance_scale;
}
std::uint32_t Diagram::width() const {
    return implementation_->window.width;
}
std::uint32_t Diagram::height() const {
    return implementation_->window.height;
}
Diagram::Method Diagram::method() const {
    return implementation_->method();
}

Diagram::Implementation::Implementation(const DiagramWindow& the_window)
    : window(the_window),
      owners("diagram owners", std::size_t{4} * the_window.width * the_window.height),
      distances("diagram distances", std::size_t{4} * the_window.width * the_window.height) {}

}  // namespace throng::sim
