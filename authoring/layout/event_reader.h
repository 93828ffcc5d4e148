// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "authoring/layout.h"
#include "authoring/layout/given_reader.h"
#include "authoring/layout/object_reader.h"
#include "authoring/layout/place_reader.h"
#include "authoring/layout/seat_reader.h"

namespace throng::authoring {

/// Reads events, after whom and what they name.
class EventReader {
  public:
    EventReader(const Schema& schema, Layout& layout, PlaceReader& places, const SeatReader& seats,
                const GivenReader& given, const Indices& groups, const Indices& walls,
                Diagnostics& diagnostics)
        : schema_(schema),
          layout_(layout),
          places_(places),
          seats_(seats),
          given_(given),
          groups_(groups),
          walls_(walls),
          diagnostics_(diagnostics) {}

    /// What happens is one key; what else belongs to it depends on which.
    void read(const JsonNode& node);
    /// Gates are open or closed at first, as their first event would have it.
    void sort();

  private:
    void readSending(ObjectReader& reader, const JsonNode& to, Event& event);
    std::vector<std::string> namesOfSent() const;
    std::vector<std::string> namesOfFlows() const;
    bool findSubject(const JsonNode& node, Event& event);

    const Schema& schema_;
    Layout& layout_;
    PlaceReader& places_;
    const SeatReader& seats_;
    const GivenReader& given_;
    const Indices& groups_;
    const Indices& walls_;
    Diagnostics& diagnostics_;
};

}  // namespace throng::authoring
