#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace orbwatch::app::modbus {

/// Cuts what comes over one TCP connection into Modbus frames, by the MBAP header (transaction,
/// protocol 0, length, unit). Strict: bytes that are no such frame leave it broken for good, since
/// nothing says where the next one would begin. Knows no socket. Thread-bound.
class MbapFramer {
 public:
  /// Header and the longest protocol data unit, 253 bytes.
  static constexpr std::size_t kLongestFrame = 260;

  /// Where the next bytes go; never empty once next() has returned none. What next() returned
  /// before is gone.
  std::span<std::uint8_t> room();

  /// So many bytes were put into room().
  void take(std::size_t count) { end_ += count; }

  /// The next whole frame with its header and at least a function code; none when the rest of it
  /// has not come yet, or is_broken().
  std::optional<std::span<const std::uint8_t>> next();

  /// Something else than Modbus came.
  bool is_broken() const { return broken_; }

  /// No part of a frame waits for the rest.
  bool is_empty() const { return begin_ == end_; }

 private:
  std::array<std::uint8_t, kLongestFrame> buffer_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  bool broken_ = false;
};

}  // namespace orbwatch::app::modbus
