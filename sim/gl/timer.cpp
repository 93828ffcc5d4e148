// SPDX-License-Identifier: Apache-2.0
#include "sim/gl/timer.h"

#include <epoxy/gl.h>

#include <chrono>

namespace throng::gl {

Timer::Timer(bool software) : software_(software) {
    glCreateQueries(GL_TIME_ELAPSED, 1, &query_);
}

Timer::~Timer() {
    glDeleteQueries(1, &query_);
}

double Timer::milliseconds(const std::function<void()>& work) const {
    glFinish();
    if (software_) {
        const auto start = std::chrono::steady_clock::now();
        work();
        glFinish();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    glBeginQuery(GL_TIME_ELAPSED, query_);
    work();
    glEndQuery(GL_TIME_ELAPSED);
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_, GL_QUERY_RESULT, &nanoseconds);
    return static_cast<double>(nanoseconds) * 1.0e-6;
}

const char* Timer::name() const {
    return software_ ? "wall clock around a wait for the device" : "GPU timer queries";
}

}  // namespace throng::gl
