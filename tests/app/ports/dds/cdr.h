// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace orbwatch::app::tests {

using Bytes = std::vector<std::uint8_t>;

/// Plain CDR, version 1, little-endian (DDSI-RTPS 2.5, 10.2; OMG CORBA 3.3 part 2, 9.3), written by
/// hand: every number at a multiple of its size, strings with their terminating zero.
class Cdr {
 public:
  template <class T>
  Cdr& number(T value) {
    bytes_.resize((bytes_.size() + sizeof(T) - 1) / sizeof(T) * sizeof(T));
    std::array<std::uint8_t, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if (std::endian::native == std::endian::big) std::ranges::reverse(raw);
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
    return *this;
  }
  Cdr& text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size() + 1));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    bytes_.push_back(0);
    return *this;
  }
  Cdr& blob(const Bytes& value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    return *this;
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

}  // namespace orbwatch::app::tests
