// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "authoring/overrides/matching.h"
#include "io/overrides/layered_crowd.h"

namespace throng::io {

/// What selectors mean in a crowd as it is just now.
class Selection {
  public:
    /// @param entrants of the bake, as loadEntrants() has them
    Selection(const LayeredCrowd& crowd, std::span<const authoring::Entrant> entrants)
        : crowd_(crowd), entrants_(entrants) {}

    /// By row.
    std::vector<bool> whom(const authoring::Selector& selector);
    /// Names that this bake does not know, and people who are nobody in it.
    const std::vector<std::string>& remarks() const { return remarks_; }
    /// Whom somebody of an override is in this bake.
    std::optional<std::uint32_t> rowOf(const authoring::Override& person) const;

  private:
    using Chosen = std::vector<bool>;
    Chosen meant(const authoring::Everybody&) { return Chosen(crowd_.rows(), true); }
    Chosen meant(const authoring::Changed&);
    Chosen meant(const authoring::Named& named);
    Chosen meant(const authoring::PartySize& size);
    Chosen meant(const authoring::Rows& rows);
    Chosen meant(const authoring::ListedPeople& people);
    Chosen meant(const authoring::Region& region);
    Chosen meant(const authoring::Share& share);
    Chosen meant(const authoring::Seen& seen);
    Chosen meant(const authoring::Near& near);
    Chosen meant(const authoring::Combined& combined);
    Chosen company(const authoring::Selector& of);
    Chosen nearOthers(const authoring::Near& near);
    Chosen nearWall(const authoring::Near& near);

    std::vector<std::uint32_t> parties() const;
    /// Those for whom `test(place)` is true in any of these frames in which they are there.
    template <class Test>
    Chosen whoEver(const authoring::FrameRange& frames, Test&& test);
    /// Calls visit(frame, places) for each of these frames that the bake has.
    template <class Visit>
    void eachFrame(const authoring::FrameRange& frames, Visit&& visit);
    void remark(std::string text);

    const LayeredCrowd& crowd_;
    std::span<const authoring::Entrant> entrants_;
    std::vector<std::string> remarks_;
};

}  // namespace throng::io
