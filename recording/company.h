// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/frame.h"
#include "base/plane_grid.h"
#include "recording/onlooker.h"

namespace throng::recording {

/// Who is with whom in a frame, and who of them speaks.
///
/// Those with one party are together, and so are two who stand face to face. They take turns: the next one
/// speaks after 1.6 to 3.2 s, at once (gaps are of the order of 0.2 s: Levinson and Torreira 2015). Turns
/// follow from the time and from who they are, so nothing is kept of them.
class Company {
  public:
    explicit Company(std::uint64_t seed) : seed_(seed) {}

    /// @param grid of the people's places
    void gather(std::span<const Onlooker> people, const PlaneGrid& grid);

    /// The others and oneself, as indices into the people; none who is alone.
    std::span<const std::uint32_t> of(std::uint32_t index) const;

    struct Turn {
        std::uint32_t speaker = kNone;  ///< an index into the people
        std::uint32_t number = 0;       ///< of that turn, since the shot began
    };
    /// Who speaks where somebody is who is not alone.
    Turn turnAt(std::uint32_t index, std::span<const Onlooker> people, double time) const;

  private:
    void addPairs(std::span<const Onlooker> people, const PlaneGrid& grid);
    std::uint32_t facedBy(const Onlooker& self, std::span<const Onlooker> people,
                          const PlaneGrid& grid) const;

    std::uint64_t seed_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted_;  ///< party, index
    std::vector<std::uint32_t> members_;  ///< circle after circle, each in the order of rows
    std::vector<std::pair<std::uint32_t, std::uint32_t>> circles_;  ///< by index: of members_, from and to
    std::vector<std::uint32_t> faced_;                              ///< by index
};

}  // namespace throng::recording
