// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "base/plane_grid.h"
#include "recording/bake_description.h"
#include "recording/company.h"
#include "recording/head_turn.h"
#include "recording/heads.h"
#include "recording/onlooker.h"
#include "recording/wall_watch.h"

namespace throng::recording {

/// What somebody looks at.
enum class Target : std::uint32_t {
    way,      ///< where it goes; standing: what is ahead
    aside,    ///< nothing
    company,  ///< somebody of its own
    passer,   ///< somebody who will cross close by
    other,    ///< somebody else
    thing,    ///< an EyeCatcher
    sound,    ///< an EyeCatcher that has become loud
};

/// What people attend to, and how their heads turn to it (docs/how-to/attention.md has the sources).
///
/// Heads that never turn are what gives crowds away first. Everybody looks at one target after another: at
/// those who speak in one's company, at who will cross close by, at what draws eyes, into a turn before the
/// body makes it, and at a sudden sound. Which, and for how long, is drawn from the seed and the row. The
/// head goes there on the smoothest way, as fast as heads do, up to what a neck can; eyes do the rest.
class AttentionTrack {
  public:
    static constexpr double kForesees = 0.45;  ///< s: so far ahead of a turn heads are (Onlooker::turns)

    struct Site {
        glm::dvec2 minimum{0.0}, maximum{0.0};  ///< m
        std::vector<authoring::Wall> walls;     ///< nobody looks through them
        std::vector<glm::dvec2> along_walls;    ///< WallWatch's ground
        std::vector<EyeCatcher> things;
    };
    AttentionTrack(std::size_t rows, double fps, std::uint64_t seed, Site site);

    /// The next frame. @param people all who are there, by row
    void look(std::span<const Onlooker> people, std::uint32_t frame);
    Attention operator[](std::size_t row) const;

    /// All that later frames depend on.
    std::span<std::byte> state() { return std::as_writable_bytes(std::span(heads_)); }
    std::span<const std::byte> state() const { return std::as_bytes(std::span(heads_)); }

  private:
    struct Head {
        HeadTurn yaw, pitch;  ///< of the yaw in the plane
        float weight = 0.0f, weight_rate = 0.0f;
        float chest = 0.0f;                 ///< rad, in the plane, of the frame before
        float aim = 0.0f, aim_rate = 0.0f;  ///< rad, in the plane: where the target is
        float settles = 0.0f;               ///< s, until the head is there
        float aside = 0.0f, up = 0.0f;      ///< rad: where to, of `aside`
        float share = 1.0f;                 ///< of the way to the target that the head goes
        float left = 0.0f;                  ///< s, until the eyes go elsewhere
        float rests = 0.0f;                 ///< s, for which no passer is looked at
        Target target = Target::way;
        std::uint32_t at = 0;  ///< somebody's row, or a thing
        std::uint32_t draws = 0;
        std::uint32_t heard = 0;   ///< of the sounds, in their order
        std::uint32_t speaks = 0;  ///< 1: it does
        std::uint32_t turn = 0;    ///< of those who speak
        std::uint32_t known = 0;   ///< 0: has not been here yet
    };
    static constexpr float kAtOnce =
        -1.0f;  ///< Head::settles: how long it takes to get there is not known yet
    struct Aim {
        double yaw = 0.0, pitch = 0.0;  ///< rad, from the chest to the left, and up
    };
    struct Draw;  ///< what there is to look at, each with a weight

    double draw(std::uint32_t row);
    double between(std::uint32_t row, double low, double high) { return low + (high - low) * draw(row); }
    void enter(Head& head, const Onlooker& self);
    void turnTo(const Onlooker& self, Target target, std::uint32_t at, double seconds, double share = 1.0);

    void decide(std::uint32_t index);
    bool hear(const Onlooker& self);
    void listen(std::uint32_t index);
    bool notice(std::uint32_t index);
    void minds(const Onlooker& self);
    bool isLost(const Onlooker& self) const;
    void choose(std::uint32_t index);
    void talk(std::uint32_t index);
    void stroll(std::uint32_t index);
    void drawPeople(std::uint32_t index, Draw& draw) const;
    void drawThings(const Onlooker& self, Draw& draw) const;
    void glanceAside(const Onlooker& self, double away_from = 0.0);

    bool isTalking(std::uint32_t index) const;
    bool sees(const Onlooker& self, glm::dvec2 place) const;
    bool seesThing(const Onlooker& self, glm::dvec2 place) const;
    const Onlooker* personAt(const Head& head) const;
    Aim aimOf(const Onlooker& self) const;
    static double keepWithin(Head& head, double chest, double rate, double least, double most);
    void liven(const Onlooker& self, Aim& aim) const;
    void follow(const Onlooker& self);
    void weigh(Head& head, const Onlooker& self, double yaw);

    double interval_;  ///< s
    std::uint64_t seed_;
    std::vector<EyeCatcher> things_;
    std::vector<std::uint32_t> sounds_;  ///< of things_, in the order of their times
    std::vector<Head> heads_;
    mutable WallWatch walls_;
    PlaneGrid grid_;
    Company company_;
    std::span<const Onlooker> people_;  ///< of this frame, while it is looked at
    std::uint32_t frame_ = 0;
    double time_ = 0.0;                 ///< s
    std::vector<std::uint32_t> index_;  ///< of rows, in the people of this frame; kNone of who is not there
    std::vector<glm::dvec2> places_;
};

}  // namespace throng::recording
