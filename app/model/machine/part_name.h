// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app {

/// Name of the part that a machine makes: one line of UTF-8 without control characters. Fixed size,
/// no heap: it is copied with each status. Reentrant.
class PartName {
 public:
  static constexpr std::size_t kMost = 32;  ///< bytes

  /// No name.
  PartName() = default;

  /// Error: more than kMost bytes, not UTF-8, or a control character.
  static Result<PartName> make(std::string_view text);

  /// Zero-terminated.
  std::string_view text() const { return bytes_.data(); }

  bool operator==(const PartName&) const = default;

 private:
  std::array<char, kMost + 1> bytes_{};
};

}  // namespace orbwatch::app
