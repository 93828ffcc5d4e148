// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "sim/gl/buffer.h"
#include "sim/gl/program.h"

namespace throng::gl {

/// A picture of one 32-bit value a pixel that is drawn into, with a margin on all sides: point sprites are
/// clipped by their centres, so those that reach into the window from outside need room around it.
class RasterTarget {
  public:
    enum class Kind {
        unsigned_nearest,  ///< unsigned words; the depth test keeps the nearest fragment (32-bit float)
        float_minimum,     ///< floats; blending keeps the smallest
    };

    /// @param what names the user in messages
    /// @throws GraphicsError when the device cannot draw that
    RasterTarget(const std::string& what, Kind kind, std::uint32_t width, std::uint32_t height,
                 std::uint32_t margin);
    ~RasterTarget();
    RasterTarget(RasterTarget&& other) noexcept;
    RasterTarget& operator=(RasterTarget&&) = delete;

    std::uint32_t margin() const { return margin_; }
    glm::vec2 size() const;  ///< px, with the margins
    std::uint32_t texture() const { return texture_; }
    const std::shared_ptr<const Contents>& contents() const { return contents_; }

    /// Everywhere "nobody": NO_INDEX and the farthest depth, or a float above all others.
    void clear();
    void drawPoints(const Program& program, std::uint32_t count);
    void drawTriangles(const Program& program, std::uint32_t vertices, std::uint32_t instances);
    /// Copies the window, bottom line first and without the margin, into the start of `buffer`.
    void readInto(const Buffer& buffer) const;

    /// @throws GraphicsError when the device's largest point sprite is smaller than `pixels`
    static void requirePointSize(const std::string& what, float pixels);

  private:
    void begin(const Program& program);

    Kind kind_;
    std::uint32_t width_, height_, margin_;
    std::shared_ptr<const Contents> contents_;
    std::uint32_t texture_ = 0;
    std::uint32_t depth_texture_ = 0;
    std::uint32_t framebuffer_ = 0;
    std::uint32_t vertex_array_ = 0;
};

}  // namespace throng::gl
