// SPDX-License-Identifier: Apache-2.0
#include "cli/terminal/interrupt.h"

#include <csignal>

namespace throng::cli {
namespace {

// Signal handlers can reach nothing but a global.
volatile std::sig_atomic_t noted_signal = 0;

void note(int signal) {
    if (noted_signal) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
    noted_signal = signal;
}

}  // namespace

InterruptGuard::InterruptGuard() {
    noted_signal = 0;
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

int InterruptGuard::signal() const {
    return noted_signal;
}

}  // namespace throng::cli
