// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "authoring/diagnostics.h"
#include "authoring/layout.h"
#include "authoring/scene.h"
#include "authoring/scene/random.h"
#include "authoring/scene/rebase.h"
#include "authoring/scene/routes.h"

namespace throng::authoring {

/// The way of one group of people: states that come one after the other, the last of which is the goal.
struct Journey {
    std::string traveller{};  ///< "flow `id`", for messages
    SourcePosition where{};
    bool keep_to_roads = false;
    std::vector<BehaviourState> stops{};
    std::uint64_t first_draw = 0;  ///< tells the draws of several journeys of one group apart
};

/// Who walks: draws are the party's, so that its members stay together.
struct Traveller {
    std::uint64_t leader = 0;  ///< index within its group of the party's first
    std::uint32_t member = 0;  ///< which of the party
    std::uint32_t party_size = 1;
    float radius = 0.25f;
};

/// Turns journeys into the stages that people walk: what comes next in them depends on nobody, so they are
/// written down beforehand, and the device's table of states (BehaviourTables) is not asked.
class Itineraries {
  public:
    Itineraries(const Layout& layout, const Rebase& rebase, const WalkGeometry& geometry, Routes& routes,
                Diagnostics& diagnostics, Scene& scene);

    /// Whether everybody walks the same stages.
    static bool isShared(const Journey& journey);
    /// Complains about stops that nobody can reach from one of these outlines on.
    /// @param start what these are called, for messages
    void check(const Journey& journey, const std::string& start, std::vector<LocalPolygon> from);
    /// Appends a traveller's stages to the scene's.
    /// @returns how many; the scene's last stage has the goal
    std::uint32_t appendStages(const Journey& journey, const GroupRandom& random, const Traveller& traveller);

    /// Solves what journeys of flows and formations will ask for, at once.
    void prepare();
    /// How many fields these are.
    static std::size_t destinationCount(const Layout& layout);
    /// A line that people wait in; what has the same points and spacing is the same one. Its tickets are the
    /// caller's to count.
    std::uint32_t lineFor(const std::vector<glm::dvec2>& points, double spacing);
    /// The field of a destination. @param choice which of its places, where one is chosen
    std::uint32_t fieldTo(const Destination& to, bool keep_to_roads, std::size_t choice = 0);

    /// Points spread evenly over a polygon (the R2 sequence, Roberts 2018), clear of walls by `clearance`,
    /// and at least `inset` from the polygon's edges, or as much as there is room for.
    class Spread {
      public:
        Spread(LocalPolygon outline, const WalkGeometry& geometry, float clearance, float inset = 0.0f);
        /// @returns nothing where many tries found no room
        std::optional<glm::vec2> next();

      private:
        LocalPolygon outline_;
        const WalkGeometry* geometry_;
        float clearance_;
        float inset_;
        double x_ = 0.5, y_ = 0.5;
    };

  private:
    gpu::Stage stopStage(const BehaviourState& stop, const Place& place, std::uint32_t field, double wait,
                         const Traveller& traveller);
    glm::vec2 spotFor(const Place& place, const Traveller& traveller, glm::vec2& middle);
    using Destinations = std::vector<std::vector<Place>>;
    static std::array<Destinations, 2> wanted(const Layout& layout);
    std::size_t chosen(const Destination& to, const GroupRandom& random, std::uint64_t leader,
                       std::uint64_t draw) const;

    const Layout& layout_;
    const Rebase& rebase_;
    const WalkGeometry& geometry_;
    Routes& routes_;
    Diagnostics& diagnostics_;
    Scene& scene_;
    std::map<std::string, Spread> spreads_;         // by place
    std::map<std::string, glm::vec2> party_spots_;  // the last party's, by place
    std::map<std::string, std::uint32_t> lines_;    // by their points
};

}  // namespace throng::authoring
