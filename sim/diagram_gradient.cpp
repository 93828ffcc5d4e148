// SPDX-License-Identifier: Apache-2.0
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <cmath>

#include "sim/diagram_methods.h"
#include "sim/gl/context.h"

namespace throng::sim {

GradientDiagram::GradientDiagram(const gl::ShaderLibrary& library, const DiagramWindow& the_window)
    : Implementation(the_window),
      program_(library, {"shaders/diagram_gradient.vert", "shaders/diagram_gradient.frag"}, {}),
      margin_(static_cast<std::uint32_t>(std::ceil(the_window.largest_radius)) + 1) {
    const std::uint32_t width = window.width + 2 * margin_;
    const std::uint32_t height = window.height + 2 * margin_;
    GLint texture_limit = 0;
    GLfloat sprite_limits[2] = {};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture_limit);
    glGetFloatv(GL_POINT_SIZE_RANGE, sprite_limits);
    if (2.0f * window.largest_radius + 1.0f > sprite_limits[1])
        throw gl::GraphicsError(
            fmt::format("method gradient1: this device draws point sprites of at most {} px, and a tile of "
                        "radius {} px needs {}. Use the method per-site or fewer pixels per metre.",
                        sprite_limits[1], window.largest_radius, 2.0f * window.largest_radius + 1.0f));
    if (std::max(width, height) > static_cast<std::uint32_t>(texture_limit))
        throw gl::GraphicsError(
            fmt::format("method gradient1: the diagram needs a texture of {} x {} px and this device stops "
                        "at {}. Use fewer pixels per metre.",
                        width, height, texture_limit));

    glCreateTextures(GL_TEXTURE_2D, 1, &owner_texture_);
    glTextureStorage2D(owner_texture_, 1, GL_R32UI, static_cast<GLsizei>(width),
                       static_cast<GLsizei>(height));
    glCreateTextures(GL_TEXTURE_2D, 1, &depth_texture_);
    glTextureStorage2D(depth_texture_, 1, GL_DEPTH_COMPONENT32F, static_cast<GLsizei>(width),
                       static_cast<GLsizei>(height));
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, owner_texture_, 0);
    glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_texture_, 0);
    if (glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw gl::GraphicsError(
            "method gradient1: this device cannot draw unsigned integers with a 32-bit float depth");
    glCreateVertexArrays(1, &vertex_array_);

    // A power of two above every squared distance keeps depth within [0, 1] without rounding it.
    distance_scale = std::exp2(std::ceil(std::log2(window.largest_radius * window.largest_radius)) + 1.0f);
    program_.set("target_size", glm::vec2(width, height));
    program_.set("margin", static_cast<float>(margin_));
    program_.set("depth_scale", 1.0f / distance_scale);
}

GradientDiagram::~GradientDiagram() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &owner_texture_);
    glDeleteTextures(1, &depth_texture_);
    glDeleteVertexArrays(1, &vertex_array_);
}

void GradientDiagram::connect(const Diagram::Input& input) {
    program_.bind("Sites", *input.sites);
    program_.bind("DrawOrder", *input.draw_order);
    draw_count_ = input.draw_count;
}

void GradientDiagram::draw() {
    const GLuint none = gpu::NO_INDEX;
    const GLfloat far_depth = 1.0f;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, static_cast<GLsizei>(window.width + 2 * margin_),
               static_cast<GLsizei>(window.height + 2 * margin_));
    glClearNamedFramebufferuiv(framebuffer_, GL_COLOR, 0, &none);
    glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far_depth);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(vertex_array_);
    program_.use();
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(draw_count_));
}

void GradientDiagram::build(bool with_distances) {
    draw();
    const auto corner = static_cast<GLint>(margin_);
    const auto width = static_cast<GLsizei>(window.width);
    const auto height = static_cast<GLsizei>(window.height);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, owners.handle());
    glReadPixels(corner, corner, width, height, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    if (with_distances) {
        glBindBuffer(GL_PIXEL_PACK_BUFFER, distances.handle());
        glReadPixels(corner, corner, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace throng::sim
