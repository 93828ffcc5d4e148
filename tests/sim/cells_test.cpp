// SPDX-License-Identifier: Apache-2.0
// People sorted into cells on the device, against a plain sort: in small worlds and in wide, nearly empty
// ones, where only the cells that somebody enters or leaves are touched.
#include <algorithm>
#include <random>

#include "sim/cell_sort.h"
#include "tests/sim/gpu_test.h"
#include "tests/sim/scenes.h"

namespace throng::test {
namespace {

class CellsTest : public GpuTest {
  protected:
    /// `count` people who are somewhere in a world of `side` metres.
    void populate(std::uint32_t count, float side) {
        authoring::Scene scene = emptyScene({0, 0}, {side, side});
        for (std::uint32_t row = 0; row < count; ++row)
            addPerson(scene, anywhere(side), {1, 1}, 1.0f);
        parameters_ = sim::makeParameters(scene);
        buffers_ = std::make_unique<sim::Buffers>(scene, parameters_);
        states_ = buffers_->states.download<gpu::AgentState>(count);
    }

    static bool isThere(const gpu::AgentState& state) {
        return state.status == gpu::STATUS_WALKING || state.status == gpu::STATUS_ARRIVED;
    }

    glm::vec2 anywhere(float side) {
        std::uniform_real_distribution<float> along(0.0f, side);
        const float x = along(random_);
        return {x, along(random_)};
    }

    std::uint32_t cellOf(glm::vec2 position) const {
        const glm::vec2 at = (position - parameters_.cells_minimum) / parameters_.cell_size;
        return static_cast<std::uint32_t>(at.y) * parameters_.cells_width + static_cast<std::uint32_t>(at.x);
    }

    /// The rows of all who are there, cell by cell, and within a cell by row.
    std::vector<std::uint32_t> plainOrder() const {
        std::vector<std::uint32_t> rows;
        for (std::uint32_t row = 0; row < states_.size(); ++row)
            if (isThere(states_[row])) rows.push_back(row);
        std::stable_sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) {
            return cellOf(states_[a].position) < cellOf(states_[b].position);
        });
        return rows;
    }

    /// Sorts on the device and compares the order of the people and where each cell starts.
    void expectSorted(sim::CellSort& sort, sim::CellSort::SiteIds ids = sim::CellSort::SiteIds::slots) {
        buffers_->states.upload(states_);
        sort.run(ids);
        const std::vector<std::uint32_t> order = plainOrder();
        const auto live = buffers_->live_dispatch.download<std::uint32_t>(4);
        ASSERT_EQ(live[3], order.size());
        const auto bodies = buffers_->bodies.download<gpu::Body>(order.size());
        const auto sites = buffers_->sites.download<gpu::DiagramSite>(order.size());
        const auto places = buffers_->site_slots.download<std::uint32_t>(states_.size());
        const bool rows = ids == sim::CellSort::SiteIds::rows;
        for (std::uint32_t slot = 0; slot < order.size(); ++slot) {
            ASSERT_EQ(bodies[slot].row, order[slot]) << "slot " << slot;
            ASSERT_EQ(sites[slot].id, rows ? order[slot] : slot);
            ASSERT_EQ(places[sites[slot].id], slot);
        }

        const std::uint32_t cells = parameters_.cells_width * parameters_.cells_height;
        const auto offsets = buffers_->cell_offsets.download<std::uint32_t>(cells + 1);
        const auto strips = buffers_->strip_starts.download<std::uint32_t>(cells / gpu::CELLS_PER_STRIP + 1);
        std::size_t slot = 0;
        for (std::uint32_t cell = 0; cell <= cells; ++cell) {
            while (slot < order.size() && cellOf(states_[order[slot]].position) < cell)
                ++slot;
            ASSERT_EQ(strips[cell / gpu::CELLS_PER_STRIP] + offsets[cell], slot) << "cell " << cell;
        }
    }

    std::mt19937 random_{5};
    gpu::Parameters parameters_{};
    std::unique_ptr<sim::Buffers> buffers_;
    std::vector<gpu::AgentState> states_;
};

TEST_F(CellsTest, EverybodyIsInTheRunOfTheirCell) {
    for (const std::uint32_t count : {1u, 63u, 1234u})
        for (const float side : {0.5f, 7.5f, 40.0f, 900.0f}) {
            SCOPED_TRACE(testing::Message() << count << " people in " << side << " m");
            populate(count, side);
            sim::CellSort sort(library, *buffers_, parameters_);
            expectSorted(sort);
        }
}

TEST_F(CellsTest, NobodyIsLeftBehindWhereTheyWere) {
    constexpr float kSide = 700.0f;
    populate(1234, kSide);
    sim::CellSort sort(library, *buffers_, parameters_);
    for (int step = 0; step < 6; ++step) {
        SCOPED_TRACE(testing::Message() << "step " << step);
        for (std::size_t row = 0; row < states_.size(); ++row) {
            const bool jumps = step == 4 || (row + static_cast<std::size_t>(step)) % 3 == 0;
            if (jumps) states_[row].position = anywhere(kSide);
            const bool gone = (row / 7 + static_cast<std::size_t>(step)) % 5 == 0;
            states_[row].status = gone           ? gpu::STATUS_GONE
                                  : row % 3 == 0 ? gpu::STATUS_ARRIVED
                                                 : gpu::STATUS_WALKING;
        }
        expectSorted(sort, step % 2 == 0 ? sim::CellSort::SiteIds::slots : sim::CellSort::SiteIds::rows);
    }
    for (gpu::AgentState& state : states_)
        state.status = gpu::STATUS_GONE;
    expectSorted(sort);
    states_.back().status = gpu::STATUS_WALKING;
    expectSorted(sort);
}

}  // namespace
}  // namespace throng::test
