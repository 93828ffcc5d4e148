// SPDX-License-Identifier: Apache-2.0
#include "sim/gl/journal.h"

#include <epoxy/gl.h>

#include <chrono>
#include <stdexcept>
#include <utility>

namespace throng::gl {
namespace {

thread_local Journal* kept_journal = nullptr;

}  // namespace

Journal::Journal(Times times) : times_(times) {
    if (kept_journal) throw std::logic_error("a journal is being kept already");
    kept_journal = this;
}

Journal::~Journal() {
    kept_journal = nullptr;
    glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

Journal* Journal::kept() {
    return kept_journal;
}

void Journal::note(const std::string& what, std::vector<Touch> touches, const std::string& declared) {
    readClock();
    commands_.push_back({pass_, declared, what, std::move(touches)});
}

void Journal::readClock() {
    if (times_ == Times::of_device) {
        glCreateQueries(GL_TIMESTAMP, 1, &queries_.emplace_back());
        glQueryCounter(queries_.back(), GL_TIMESTAMP);
    } else if (times_ == Times::of_wall) {
        using Milliseconds = std::chrono::duration<double, std::milli>;
        glFinish();
        wall_.push_back(Milliseconds(std::chrono::steady_clock::now().time_since_epoch()).count());
    }
}

std::vector<double> Journal::milliseconds() {
    if (times_ == Times::none) throw std::logic_error("a journal that keeps no times was asked for them");
    readClock();  // the end of the last command
    std::vector<double> clock = std::move(wall_);
    for (const GLuint query : queries_) {
        GLuint64 nanoseconds = 0;
        glGetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds);
        clock.push_back(static_cast<double>(nanoseconds) * 1.0e-6);
    }
    std::vector<double> times;
    for (std::size_t i = 0; i + 1 < clock.size(); ++i)
        times.push_back(clock[i + 1] - clock[i]);
    return times;
}

void Journal::noteAlso(const Touch& touch) {
    commands_.back().touches.push_back(touch);
}

}  // namespace throng::gl
