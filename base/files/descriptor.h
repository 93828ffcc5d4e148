// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <utility>

namespace throng {

/// Closes an open file when it goes; holds none where the number is negative.
class Descriptor {
  public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { reset(); }
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        reset(std::exchange(other.number_, -1));
        return *this;
    }
    int get() const { return number_; }
    bool isOpen() const { return number_ >= 0; }
    void reset(int number = -1) {
        if (isOpen()) ::close(number_);
        number_ = number;
    }

  private:
    int number_ = -1;
};

}  // namespace throng
