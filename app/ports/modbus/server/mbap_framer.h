#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace orbwatch::app::modbus {

/// Splits the bytes of one TCP connection into Modbus frames by the MBAP header (transaction,
/// protocol 0, length, unit). Any other bytes break it for good: nothing marks the next frame.
/// Knows no socket. Thread-bound.
class MbapFramer {
 public:
  /// Header and the longest protocol data unit, 253 bytes.
  static constexpr std::size_t kLongestFrame = 260;

  /// The place for the next bytes; never empty once next() returned nullopt. Invalidates the frame
  /// returned before.
  std::span<std::uint8_t> room();

  /// `count` bytes were written to room().
  void commit(std::size_t count) { end_ += count; }

  /// The next whole frame with its header and at least a function code; nullopt while it is
  /// incomplete, or is_broken().
  std::optional<std::span<const std::uint8_t>> next();

  /// It received something else than Modbus.
  bool is_broken() const { return broken_; }

  /// It holds no part of an incomplete frame.
  bool is_empty() const { return begin_ == end_; }

 private:
  std::array<std::uint8_t, kLongestFrame> buffer_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  bool broken_ = false;
};

}  // namespace orbwatch::app::modbus
