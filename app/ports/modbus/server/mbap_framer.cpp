// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/mbap_framer.h"

#include <algorithm>

namespace orbwatch::app::modbus {
namespace {

constexpr std::size_t kPrefix = 6;    // transaction, protocol and length
constexpr std::size_t kShortest = 2;  // unit and function code, which the length includes
constexpr std::size_t kLongest = MbapFramer::kLongestFrame - kPrefix;

}  // namespace

std::span<std::uint8_t> MbapFramer::room() {
  const auto bytes = std::span(buffer_).subspan(begin_, end_ - begin_);
  std::ranges::copy(bytes, buffer_.begin());
  begin_ = 0;
  end_ = bytes.size();
  return std::span(buffer_).subspan(end_);
}

std::optional<std::span<const std::uint8_t>> MbapFramer::next() {
  const auto bytes = std::span<const std::uint8_t>(buffer_).subspan(begin_, end_ - begin_);
  if (broken_ || bytes.size() < kPrefix) return std::nullopt;
  const int protocol = bytes[2] << 8 | bytes[3];
  const auto length = static_cast<std::size_t>(bytes[4] << 8 | bytes[5]);
  broken_ = protocol != 0 || length < kShortest || length > kLongest;
  if (broken_ || bytes.size() < kPrefix + length) return std::nullopt;
  begin_ += kPrefix + length;
  return bytes.first(kPrefix + length);
}

}  // namespace orbwatch::app::modbus
