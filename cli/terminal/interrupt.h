// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace throng::cli {

/// While it lives, Ctrl-C and SIGTERM are noted instead of ending the process, as only a second one does.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// The signal that came, or 0.
    int signal() const;
};

}  // namespace throng::cli
