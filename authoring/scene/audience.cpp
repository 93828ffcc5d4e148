// SPDX-License-Identifier: Apache-2.0
#include "authoring/scene/audience.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "authoring/scene/people.h"
#include "authoring/scene/random.h"

namespace throng::authoring {
namespace {

constexpr double kHalf = 0.5;
constexpr double kHandsUpFor = 0.35, kHandsDownFor = 0.45;  // s
constexpr double kSwayFor = 2.4;                            // s a cycle, the same for all: they sing one song
// Cycles/s. Audiences that are not in step clap about four times a second (Neda et al. 2000, figure 1).
constexpr Distribution kClaps{Distribution::Kind::normal, 4.0, 0.4, 3.0, 5.0};
constexpr Distribution kCheers{Distribution::Kind::normal, 1.6, 0.2, 1.1, 2.1};
constexpr Distribution kSits{Distribution::Kind::uniform, 0.16, 0.0, 0.12, 0.2};

/// Which seats of a block are taken, and by whom together.
class Seating {
  public:
    Seating(const SeatBlock& block, const GroupRandom& random, std::size_t seats)
        : occupancy_(block.occupancy), random_(random), drawn_(drawParties(block.people, random, seats)) {}

    /// Parties in neighbouring seats of a row, from `first` to before `end`, with gaps between them.
    void fill(std::size_t first, std::size_t end) {
        const std::size_t count = end - first;
        // The occupancy of a short row is hit on average.
        const double wanted = occupancy_ * static_cast<double>(count);
        const std::size_t people =
            std::min(count, static_cast<std::size_t>(wanted + random_.unit(first, Purpose::seat)));
        std::vector<std::uint32_t> sizes;
        for (std::size_t seated = 0; seated < people; seated += sizes.back(), ++next_)
            sizes.push_back(static_cast<std::uint32_t>(
                std::min<std::size_t>(drawn_[next_ % drawn_.size()].size, people - seated)));
        // Each empty seat falls before one of the parties, or behind the last.
        std::vector<std::size_t> gaps(sizes.size() + 1, 0);
        for (std::size_t i = 0; i < count - people; ++i)
            ++gaps[random_.word(first + i, Purpose::seat, 1) % gaps.size()];
        std::size_t at = first;
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            at += gaps[i];
            parties.push_back({taken.size(), sizes[i]});
            for (std::uint32_t member = 0; member < sizes[i]; ++member)
                taken.push_back(at++);
        }
    }

    std::vector<std::size_t> taken;
    std::vector<Party> parties;  ///< of those in `taken`

  private:
    double occupancy_;
    const GroupRandom& random_;
    std::vector<Party> drawn_;
    std::size_t next_ = 0;
};

void seatBlock(const Layout& layout, std::size_t index, std::vector<Spectator>& audience) {
    const SeatBlock& block = layout.seats[index];
    const GroupRandom random(layout.simulation.seed, block.id);
    const std::vector<Seat> seats = seatsOf(block);
    if (seats.empty()) return;
    Seating seating(block, random, seats.size());
    for (std::size_t first = 0, end = 0; first < seats.size(); first = end) {
        while (end < seats.size() && seats[end].row == seats[first].row &&
               seats[end].section == seats[first].section)
            ++end;
        seating.fill(first, end);
    }
    const auto before = static_cast<std::uint32_t>(audience.size());
    for (const std::size_t seat : seating.taken)
        audience.push_back({index, seat, seats[seat], drawPerson(block.people, random, seat, 0), 0, {}});
    for (const Party& party : seating.parties)
        for (std::uint32_t i = 0; i < party.size; ++i)
            audience[before + party.first + i].party = before + static_cast<std::uint32_t>(party.first);
}

/// What one person does, as it comes: whole cycles, so that no pose jumps where one goes over into the next.
class Timeline {
  public:
    Timeline(std::vector<Deed>& deeds, double begin, double phase, double sits_at)
        : deeds_(deeds), sits_at_(sits_at), free_(begin) {
        deeds_.push_back({begin, ActivityCode::sits, phase, sits_at});
    }
    double freeFrom() const { return free_; }

    void sitUntil(double time) {
        // In whole cycles: what it does next begins as sitting upright does.
        Deed& sits = deeds_.back();
        const double seconds = time - sits.begin;
        phase_ = std::max(std::ceil(sits.phase), std::round(sits.phase + seconds * sits_at_));
        sits.rate = seconds > 0.0 ? (phase_ - sits.phase) / seconds : 0.0;
        free_ = time;
    }
    /// @param cycles of it
    void act(ActivityCode activity, double seconds, double cycles, double from = 0.0) {
        phase_ = std::ceil(phase_) + from;
        deeds_.push_back({free_, activity, phase_, cycles / seconds});
        free_ += seconds;
        phase_ += cycles;
    }
    void sit() {
        phase_ = std::ceil(phase_);
        deeds_.push_back({free_, ActivityCode::sits, phase_, sits_at_});
    }

  private:
    std::vector<Deed>& deeds_;
    double sits_at_, free_, phase_ = 0.0;
};

/// One appearance of one person in a show.
struct Cue {
    double at = 0.0;     ///< s
    double lasts = 0.0;  ///< s; of a wave, from rising to sitting again
    double beat = 0.0;   ///< s: sing: a moment at which a cycle begins
    Show::Kind kind = Show::Kind::clap;
};

void perform(const Cue& cue, const GroupRandom& random, std::size_t person, Timeline& timeline) {
    constexpr double kLatest = 1.0;  // s: who is busy for longer leaves it out
    const double begin = std::max(cue.at, timeline.freeFrom());
    const bool in_time = begin - cue.at < (cue.kind == Show::Kind::wave ? 1e-3 : kLatest);
    if (!in_time) return;
    timeline.sitUntil(begin);
    const auto rounds = [&](const Distribution& pace) {
        return std::max(1.0, std::round(cue.lasts * random.draw(pace, person, Purpose::pace)));
    };
    switch (cue.kind) {
        case Show::Kind::wave:
            timeline.act(ActivityCode::rises, cue.lasts, 1.0);
            break;
        case Show::Kind::clap:
            timeline.act(ActivityCode::readies, kHandsUpFor, kHalf);
            timeline.act(ActivityCode::claps, cue.lasts, rounds(kClaps));
            timeline.act(ActivityCode::readies, kHandsDownFor, kHalf, kHalf);
            break;
        case Show::Kind::cheer:
            timeline.act(ActivityCode::rises, kRisesFor, kHalf);
            timeline.act(ActivityCode::cheers, cue.lasts, rounds(kCheers));
            timeline.act(ActivityCode::rises, kSitsDownFor, kHalf, kHalf);
            break;
        case Show::Kind::sing: {
            // Up early enough to fall in with the next beat.
            const double up = begin + kRisesFor;
            const double beat = cue.beat + std::ceil((up - cue.beat) / kSwayFor) * kSwayFor;
            timeline.act(ActivityCode::rises, beat - begin, kHalf);
            const double cycles = std::max(1.0, std::round(cue.lasts / kSwayFor));
            timeline.act(ActivityCode::sings, cycles * kSwayFor, cycles);
            timeline.act(ActivityCode::rises, kSitsDownFor, kHalf, kHalf);
            break;
        }
    }
    timeline.sit();
}

/// Where a wave passes, along the blocks of a show, m.
class WaveCourse {
  public:
    WaveCourse(const Layout& layout, const Show& show) : begins_(layout.seats.size(), -1.0) {
        for (const std::size_t block : show.blocks) {
            begins_[block] = length_;
            length_ += lengthOf(layout.seats[block]);
        }
        if (!show.from) return;
        double nearest = std::numeric_limits<double>::max();
        // Of all blocks, whether people walk to them or not.
        for (const std::size_t block : show.blocks)
            for (const Spectator& each : audienceIn(layout, block)) {
                const double away = glm::distance(each.seat.place - layout.seats[block].shift, *show.from);
                if (away >= nearest) continue;
                nearest = away;
                start_ = begins_[each.block] + each.seat.along;
            }
    }
    double length() const { return length_; }
    /// m from its beginning.
    double wayTo(const Spectator& spectator) const {
        constexpr double kWithTheFirst = 1.0;  // m behind the beginning
        const double way = begins_[spectator.block] + spectator.seat.along - start_;
        return way < -kWithTheFirst ? way + length_ : std::max(way, 0.0);
    }

  private:
    std::vector<double> begins_;
    double length_ = 0.0, start_ = 0.0;
};

/// Everybody's cues of one show.
void addCues(const Layout& layout, std::size_t number, const std::vector<Spectator>& audience,
             std::vector<std::vector<Cue>>& cues) {
    const Show& show = layout.shows[number];
    const GroupRandom random(layout.simulation.seed, fmt::format("show {}", number));
    const WaveCourse course(layout, show);
    std::vector<bool> takes_part(layout.seats.size(), false);
    for (const std::size_t block : show.blocks)
        takes_part[block] = true;
    // Half of the way up to half of the way down: so long the wave is over somebody.
    constexpr double kRiseOfPassing = 2.0;
    for (std::size_t i = 0; i < audience.size(); ++i) {
        const Spectator& each = audience[i];
        if (!takes_part[each.block] || random.unit(i, Purpose::show) >= show.share) continue;
        const double at = random.draw(show.at, show.kind == Show::Kind::wave ? 0 : i, Purpose::time);
        const double late = random.draw(show.reaction, i, Purpose::reaction);
        if (show.kind != Show::Kind::wave) {
            cues[i].push_back({at + late, random.draw(show.lasts, i, Purpose::lasts), at, show.kind});
            continue;
        }
        const double passing = show.width * layout.seats[each.block].width / show.speed;
        for (std::uint64_t lap = 0; lap < show.laps; ++lap) {
            const double way = course.wayTo(each) + static_cast<double>(lap) * course.length();
            cues[i].push_back({at + late + way / show.speed, kRiseOfPassing * passing, at, show.kind});
        }
    }
}

}  // namespace

std::vector<Spectator> audienceIn(const Layout& layout, std::size_t block) {
    std::vector<Spectator> audience;
    seatBlock(layout, block, audience);
    return audience;
}

std::vector<std::vector<SeatCue>> cuesIn(const Layout& layout, const std::vector<Spectator>& seated) {
    const auto activityOf = [](Show::Kind kind) {
        switch (kind) {
            case Show::Kind::clap:
                return ActivityCode::claps;
            case Show::Kind::cheer:
                return ActivityCode::cheers;
            case Show::Kind::sing:
                return ActivityCode::sings;
            case Show::Kind::wave:
                break;
        }
        return ActivityCode::rises;
    };
    std::vector<std::vector<Cue>> cues(seated.size());
    for (std::size_t show = 0; show < layout.shows.size(); ++show)
        addCues(layout, show, seated, cues);
    std::vector<std::vector<SeatCue>> result(seated.size());
    for (std::size_t i = 0; i < seated.size(); ++i) {
        std::ranges::stable_sort(cues[i], {}, &Cue::at);
        for (const Cue& cue : cues[i])
            result[i].push_back({cue.at, cue.lasts, cue.beat, activityOf(cue.kind)});
    }
    return result;
}

std::vector<Spectator> audienceOf(const Layout& layout) {
    std::vector<Spectator> audience;
    for (std::size_t block = 0; block < layout.seats.size(); ++block)
        if (!layout.seats[block].isOpen()) seatBlock(layout, block, audience);
    std::vector<std::vector<Cue>> cues(audience.size());
    for (std::size_t show = 0; show < layout.shows.size(); ++show)
        addCues(layout, show, audience, cues);
    const GroupRandom random(layout.simulation.seed, "audience");
    constexpr double kBefore = -20.0;  // s: nobody begins to sit at the first frame
    for (std::size_t i = 0; i < audience.size(); ++i) {
        Timeline timeline(audience[i].deeds, kBefore, random.unit(i, Purpose::phase),
                          random.draw(kSits, i, Purpose::pace, 1));
        std::ranges::stable_sort(cues[i], {}, &Cue::at);
        for (const Cue& cue : cues[i])
            perform(cue, random, i, timeline);
    }
    return audience;
}

}  // namespace throng::authoring
