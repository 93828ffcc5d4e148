// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "io/crowd_reader.h"

namespace throng::analysis {

/// Everybody's ways, small enough for a page.
///
/// Positions are taken every few frames and rounded to 16 bits of the scene's longer side. Each is written as
/// what is left when one expects people to go on as they went (twice the last place less the one before),
/// with the sign in the lowest bit; for one moment after the other, the low bytes of all x and y, then the
/// high ones; all of it deflated (RFC 1950). In between, whoever plays it goes in straight lines.
struct PackedWays {
    std::uint32_t every = 1;  ///< frames from one moment to the next; the last frame is always one
    std::uint32_t moments = 0;
    double quantum = 0.0;  ///< m
    std::vector<unsigned char> deflated;
    /// Where there are levels, deflated as well: for one moment after the other, everybody's level by its
    /// number, or behind those the link that it is on (io::Storeys).
    std::vector<unsigned char> deflated_storeys;
    /// Where the ground makes people larger or smaller, deflated as well: for one moment after the other, how
    /// large everybody is, from half of its own size (0) to twice that (255).
    std::vector<unsigned char> deflated_sizes;
    double largest_error = 0.0;  ///< m, of all people present in all frames, straight lines included
    double usual_error = 0.0;    ///< m, root of the mean square
    std::vector<std::uint32_t> first, last;  ///< frames in which each row is there; first > last: never
};

/// Packs the ways of a bake, frame by frame.
class WayPacker {
  public:
    explicit WayPacker(const io::Bake& bake);
    ~WayPacker();
    /// All frames, in order.
    void add(const io::CrowdFrame& frame);
    PackedWays finish();

  private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace throng::analysis
