// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

namespace throng::gl {

/// How long commands take on the device.
class Timer {
  public:
    /// Software renderers answer timer queries with nonsense (zero for compute), so there the wall clock is
    /// read around a wait for the device.
    /// @param software as Device::software
    explicit Timer(bool software);
    ~Timer();
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

    /// Waits for the device, runs `work`, waits again. @returns ms
    double milliseconds(const std::function<void()>& work) const;
    /// "GPU timer queries" or "wall clock around a wait for the device"
    const char* name() const;

  private:
    bool software_;
    std::uint32_t query_ = 0;
};

}  // namespace throng::gl
