// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace orbwatch::app::web {

/// Unsent parts of a message. Refers to its bytes.
class Parts {
 public:
  bool are_sent() const {
    return std::ranges::all_of(parts_, [](std::string_view part) { return part.empty(); });
  }
  void begin(std::array<std::string_view, 3> parts) { parts_ = parts; }

  /// Writes as much as fits to `out`; returns the number of bytes.
  std::size_t read(std::span<char> out) {
    std::size_t written = 0;
    for (std::string_view& part : parts_) {
      const std::size_t count = std::min(part.size(), out.size() - written);
      std::copy_n(part.data(), count, out.data() + written);
      part.remove_prefix(count);
      written += count;
    }
    return written;
  }

 private:
  std::array<std::string_view, 3> parts_;
};

}  // namespace orbwatch::app::web
