// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "analysis/between_rows.h"
#include "base/activities.h"
#include "base/capsule.h"
#include "io/crowd_reader.h"

namespace throng::analysis {

/// Who is there in a frame, one after the other: but for people in seats, and on their way between rows of
/// them.
class Present {
  public:
    explicit Present(io::CrowdReader& crowd)
        : people_(crowd.people()), has_storeys_(crowd.bake().hasStoreys()), between_rows_(crowd.bake()) {}

    void gather(const io::CrowdFrame& frame) {
        rows_.clear();
        places_.clear();
        bodies_.clear();
        reaches_.clear();
        heights_.clear();
        for (std::uint32_t row = 0; row < people_.size(); ++row) {
            if (!frame.isThere(row) || hasSeat(frame.activity(row)) ||
                between_rows_.has(frame.place(row), frame.height(row)))
                continue;
            const Capsule body = frame.body(row, people_[row]);
            rows_.push_back(row);
            places_.push_back(body.middle);
            bodies_.push_back(body);
            reaches_.push_back(body.thickness + glm::length(body.axis));
            heights_.push_back(has_storeys_ ? frame.height(row) : 0.0);
        }
    }

    std::size_t count() const { return rows_.size(); }
    std::uint32_t row(std::size_t i) const { return rows_[i]; }
    const std::vector<glm::dvec2>& places() const { return places_; }
    const Capsule& body(std::size_t i) const { return bodies_[i]; }
    double reach(std::size_t i) const { return reaches_[i]; }        ///< m, of a body from its middle
    const std::vector<double>& heights() const { return heights_; }  ///< m; zero where there is one storey
    bool isGiven(std::size_t i) const { return people_[rows_[i]].is_given; }

  private:
    const std::vector<io::AgentRow>& people_;
    bool has_storeys_;
    BetweenRows between_rows_;
    std::vector<std::uint32_t> rows_;
    std::vector<glm::dvec2> places_;
    std::vector<Capsule> bodies_;
    std::vector<double> reaches_, heights_;
};

}  // namespace throng::analysis
