// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/diagram.h"

namespace throng::sim {

struct DiagramWindow {
    std::uint32_t width = 0;      // px
    std::uint32_t height = 0;     // px
    float largest_radius = 0.0f;  // px
};

/// What the ways to build the diagram have in common: where the result is.
struct Diagram::Implementation {
    explicit Implementation(const DiagramWindow& the_window);
    virtual ~Implementation() = default;
    virtual void connect(const Diagram::Input& input) = 0;
    virtual void build(bool with_distances) = 0;
    virtual Diagram::Method method() const = 0;

    DiagramWindow window;
    gl::Buffer owners;
    gl::Buffer distances;
    float distance_scale = 1.0f;
};

class PerSiteDiagram final : public Diagram::Implementation {
  public:
    PerSiteDiagram(const gl::ShaderLibrary& library, const DiagramWindow& window,
                   std::span<const gpu::DiagramSite> fixed_sites);
    void connect(const Diagram::Input& input) override;
    void build(bool with_distances) override;
    Diagram::Method method() const override { return Diagram::Method::per_site; }

  private:
    void splat(const gl::Buffer& live_dispatch);

    gl::ComputeProgram distance_pass_;
    gl::ComputeProgram site_pass_;
    gl::Buffer fixed_owners_;  // the diagram of the sites that never move, which every build starts from
    gl::Buffer fixed_distances_;
    const gl::Buffer* live_dispatch_ = nullptr;
};

class GradientDiagram final : public Diagram::Implementation {
  public:
    GradientDiagram(const gl::ShaderLibrary& library, const DiagramWindow& window);
    ~GradientDiagram() override;
    void connect(const Diagram::Input& input) override;
    void build(bool with_distances) override;
    Diagram::Method method() const override { return Diagram::Method::gradient1; }

    /// Draws into the textures and leaves the result there: what the benchmarks time as "one gradient1
    /// diagram".
    void draw();

  private:
    gl::Program program_;
    std::uint32_t owner_texture_ = 0;
    std::uint32_t depth_texture_ = 0;
    std::uint32_t framebuffer_ = 0;
    std::uint32_t vertex_array_ = 0;
    std::uint32_t margin_ = 0;  // px
    std::uint32_t draw_count_ = 0;
};

}  // namespace throng::sim
