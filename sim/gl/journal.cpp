// SPDX-License-Identifier: Apache-2.0
#include "sim/gl/journal.h"

#include <stdexcept>
#include <utility>

namespace throng::gl {
namespace {

thread_local Journal* kept_journal = nullptr;

}  // namespace

Journal::Journal() {
    if (kept_journal) throw std::logic_error("a journal is being kept already");
    kept_journal = this;
}

Journal::~Journal() {
    kept_journal = nullptr;
}

Journal* Journal::kept() {
    return kept_journal;
}

void Journal::note(const std::string& what, std::vector<Touch> touches, const std::string& declared) {
    commands_.push_back({pass_, declared, what, std::move(touches)});
}

void Journal::noteAlso(const Touch& touch) {
    commands_.back().touches.push_back(touch);
}

}  // namespace throng::gl
