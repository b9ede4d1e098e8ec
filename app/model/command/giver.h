// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace orbwatch::app {

/// Origin of a command: a user or a program that has logged in, else the interface. The size is
/// fixed, so that the frame path copies it without allocating; longer names are cut.
class Giver {
 public:
  static constexpr std::size_t kMostBytes = 32;

  constexpr Giver() = default;
  constexpr explicit Giver(std::string_view name) : size_(std::min(name.size(), kMostBytes)) {
    std::copy_n(name.begin(), size_, text_.begin());
  }

  /// Empty: not known. Valid as long as this object.
  constexpr std::string_view name() const { return {text_.data(), size_}; }

 private:
  std::array<char, kMostBytes> text_{};
  std::size_t size_ = 0;
};

}  // namespace orbwatch::app
