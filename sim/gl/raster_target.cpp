// SPDX-License-Identifier: Apache-2.0
#include "sim/gl/raster_target.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "shaders/shared/scene_types.h"
#include "sim/gl/context.h"

namespace throng::gl {
namespace {

GLuint makeTexture(GLenum format, std::uint32_t width, std::uint32_t height) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
    return texture;
}

}  // namespace

RasterTarget::RasterTarget(const std::string& what, Kind kind, std::uint32_t width, std::uint32_t height,
                           std::uint32_t margin)
    : kind_(kind),
      width_(width),
      height_(height),
      margin_(margin),
      contents_(std::make_shared<const Contents>(Contents{"drawing of " + what, "pixel", 4})) {
    const std::uint32_t full_width = width + 2 * margin;
    const std::uint32_t full_height = height + 2 * margin;
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (std::max(full_width, full_height) > static_cast<std::uint32_t>(limit))
        throw GraphicsError(
            fmt::format("method {}: the diagram needs a texture of {} x {} px and this device stops at {}. "
                        "Use fewer pixels per metre, or the method binned.",
                        what, full_width, full_height, limit));
    const bool nearest = kind == Kind::unsigned_nearest;
    texture_ = makeTexture(nearest ? GL_R32UI : GL_R32F, full_width, full_height);
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
    if (nearest) {
        depth_texture_ = makeTexture(GL_DEPTH_COMPONENT32F, full_width, full_height);
        glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_texture_, 0);
    }
    if (glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw GraphicsError(
            fmt::format("method {}: this device cannot draw {}. Use the method binned.", what,
                        nearest ? "unsigned integers with a 32-bit float depth" : "32-bit floats"));
    glCreateVertexArrays(1, &vertex_array_);
}

RasterTarget::~RasterTarget() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
    glDeleteTextures(1, &depth_texture_);
    glDeleteVertexArrays(1, &vertex_array_);
}

RasterTarget::RasterTarget(RasterTarget&& other) noexcept
    : kind_(other.kind_),
      width_(other.width_),
      height_(other.height_),
      margin_(other.margin_),
      contents_(std::move(other.contents_)),
      texture_(std::exchange(other.texture_, 0)),
      depth_texture_(std::exchange(other.depth_texture_, 0)),
      framebuffer_(std::exchange(other.framebuffer_, 0)),
      vertex_array_(std::exchange(other.vertex_array_, 0)) {}

glm::vec2 RasterTarget::size() const {
    return {width_ + 2 * margin_, height_ + 2 * margin_};
}

void RasterTarget::requirePointSize(const std::string& what, float pixels) {
    GLfloat limits[2] = {};
    glGetFloatv(GL_POINT_SIZE_RANGE, limits);
    if (pixels > limits[1])
        throw GraphicsError(
            fmt::format("method {}: this device draws point sprites of at most {} px, and the largest tile "
                        "needs {}. Use fewer pixels per metre, or the method binned.",
                        what, limits[1], pixels));
}

void RasterTarget::clear() {
    if (Journal* journal = Journal::kept()) journal->note("fill", {{contents_, false, true}});
    const GLuint nobody = gpu::NO_INDEX;
    const GLfloat largest[4] = {3.0e38f, 0.0f, 0.0f, 0.0f};
    const GLfloat far_depth = 1.0f;
    glDisable(GL_SCISSOR_TEST);
    if (kind_ == Kind::unsigned_nearest) {
        glClearNamedFramebufferuiv(framebuffer_, GL_COLOR, 0, &nobody);
        glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far_depth);
    } else {
        glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, largest);
    }
}

void RasterTarget::begin(const Program& program) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, static_cast<GLsizei>(width_ + 2 * margin_), static_cast<GLsizei>(height_ + 2 * margin_));
    if (kind_ == Kind::unsigned_nearest) {
        glDisable(GL_BLEND);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
    } else {
        glDisable(GL_DEPTH_TEST);
        glEnable(GL_BLEND);
        glBlendEquation(GL_MIN);
        glBlendFunc(GL_ONE, GL_ONE);
    }
    glBindVertexArray(vertex_array_);
    program.use();
    if (Journal* journal = Journal::kept()) journal->noteAlso({contents_, true, true});
}

void RasterTarget::drawPoints(const Program& program, std::uint32_t count) {
    begin(program);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count));
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void RasterTarget::drawTriangles(const Program& program, std::uint32_t vertices, std::uint32_t instances) {
    begin(program);
    glDrawArraysInstanced(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices), static_cast<GLsizei>(instances));
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void RasterTarget::readInto(const Buffer& buffer) const {
    if (Journal* journal = Journal::kept())
        journal->note("copy", {{contents_, true, false}, {buffer.contents(), false, true}});
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer.handle());
    const auto corner = static_cast<GLint>(margin_);
    const bool nearest = kind_ == Kind::unsigned_nearest;
    glReadPixels(corner, corner, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_),
                 nearest ? GL_RED_INTEGER : GL_RED, nearest ? GL_UNSIGNED_INT : GL_FLOAT, nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

}  // namespace throng::gl
