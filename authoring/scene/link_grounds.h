// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/storeys/built_links.h"
#include "authoring/storeys/surface_edges.h"

namespace throng::authoring {

/// The ground of links that are built onto a terrain: each flight, landing and cabin is a chart of its own.
class LinkGrounds {
  public:
    /// @param ground of the mesh with the links
    LinkGrounds(const std::shared_ptr<const Walkable>& ground, const BuiltLinks& built);

    /// By spot of the ground, whether it is a link's; empty where there are no links.
    const std::vector<bool>& taken() const { return taken_; }
    const std::vector<Surface>& surfaces() const { return surfaces_; }
    /// Which of the links' parts each surface is.
    const std::vector<std::size_t>& parts() const { return parts_; }
    /// Charts of the surfaces, in that order.
    void addCharts(std::vector<Chart>& charts) const;
    /// Edges of all surfaces but for those along which links have railings; openings over links are told
    /// apart.
    /// @param surfaces all, of which those of links are the last
    std::vector<SurfaceEdge> sorted(const std::vector<SurfaceEdge>& edges,
                                    const std::vector<Surface>& surfaces) const;

  private:
    const BuiltLink* partAlong(const SurfaceEdge& edge, glm::dvec2 a, glm::dvec2 b) const;
    bool isInDoorway(const SurfaceEdge& edge, const std::vector<Surface>& surfaces, glm::dvec2 place) const;
    bool hasRailing(std::size_t surface, glm::dvec2 place) const;
    SurfaceEdge::Beside besideWhat(const SurfaceEdge& edge, const BuiltLink& part, glm::dvec2 place) const;
    void addWithoutOpenings(const SurfaceEdge& edge, const Surface& ground, glm::dvec2 a, glm::dvec2 b,
                            std::vector<SurfaceEdge>& kept) const;
    void addPiece(const SurfaceEdge& edge, glm::dvec2 a, glm::dvec2 b, std::vector<SurfaceEdge>& kept) const;

    const BuiltLinks& built_;
    std::vector<bool> taken_;
    std::vector<Surface> surfaces_;
    std::vector<std::size_t> parts_;  // by surface
};

/// Finds the grounds that links lead to. Tells of those that nobody gets onto, or hardly.
/// @param first_link of the charts: before it there are grounds
void joinLinks(const Layout& layout, std::size_t first_link, std::vector<Chart>& charts,
               Diagnostics& diagnostics);

void tellOfWalls(const BuiltLinks& built, const Layout& layout, Diagnostics& diagnostics);

struct PlacedRailing {
    std::size_t chart = 0;
    Wall wall;               ///< home
    glm::dvec2 ground{0.0};  ///< m
};

/// @param first_link of the charts, which LinkGrounds added
std::vector<PlacedRailing> railingsOf(const LinkGrounds& links, const BuiltLinks& built, const Layout& layout,
                                      std::size_t first_link);

}  // namespace throng::authoring
