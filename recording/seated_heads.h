// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "recording/bake_description.h"
#include "recording/heads.h"

namespace throng::recording {

/// How heads of those who have seats turn: at once to a sound, and for a while to what draws eyes.
///
/// They stay where they are, so all follows from the time, and nothing is kept of them. Apart from that their
/// clips have them look about.
class SeatedHeads {
  public:
    SeatedHeads(std::vector<EyeCatcher> things, std::uint64_t seed);

    /// @param number of somebody, among those who have seats
    Attention at(const BakeSpectator& person, std::size_t number, double time) const;

  private:
    /// A look at something: there, a while, and back.
    struct Look {
        double yaw = 0.0, pitch = 0.0;    ///< rad
        double begin = 0.0, lasts = 0.0;  ///< s: when the head sets off, and how long it stays there
        int at = 0;                       ///< as Attention::at
        double share(double time) const;  ///< 0 to 1: how far the head is there
    };
    Look lookAt(const BakeSpectator& person, std::size_t thing) const;
    bool isNear(const BakeSpectator& person, std::size_t thing) const;
    bool isSeen(const Look& look, const BakeSpectator& person, std::size_t thing) const;
    Look spell(const BakeSpectator& person, std::size_t number, double time) const;

    std::vector<EyeCatcher> things_;
    std::uint64_t seed_;
};

}  // namespace throng::recording
