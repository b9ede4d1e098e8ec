// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace orbwatch::app::modbus {

/// Splits the bytes of one TCP connection into Modbus frames by the MBAP header (transaction,
/// protocol 0, length, unit). Any other bytes break it permanently, because the start of the next
/// frame is unknown. Independent of sockets. Thread-bound.
class MbapFramer {
 public:
  /// Length of the header and the longest protocol data unit, 253 bytes.
  static constexpr std::size_t kLongestFrame = 260;

  /// Buffer for the next bytes; never empty once next() returned nullopt. Invalidates the frame
  /// returned before.
  std::span<std::uint8_t> room();

  /// Accepts `count` bytes written to room().
  void commit(std::size_t count) { end_ += count; }

  /// The next whole frame with its header and at least a function code; nullopt while it is
  /// incomplete, or is_broken().
  std::optional<std::span<const std::uint8_t>> next();

  /// Returns whether bytes other than Modbus were received.
  bool is_broken() const { return broken_; }

  /// Returns whether there is no part of an incomplete frame.
  bool is_empty() const { return begin_ == end_; }

 private:
  std::array<std::uint8_t, kLongestFrame> buffer_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  bool broken_ = false;
};

}  // namespace orbwatch::app::modbus
