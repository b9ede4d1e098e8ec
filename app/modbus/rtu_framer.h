#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/clock.h"

namespace orbwatch::app::modbus {

/// Cuts what comes over a serial line into the Modbus RTU frames for one unit (Modbus over Serial
/// Line V1.02, 2.5.1). Frames for other units, their answers and what has a wrong checksum are
/// passed over, as the standard says.
///
/// The standard ends a frame by a pause of 3.5 characters. Adapters on USB deliver a frame in
/// pieces with longer pauses between them, and two frames in one piece. So a frame ends where its
/// function code says, or else where its checksum comes out right; pauses only say where to begin
/// again after something that was no frame.
/// Knows no device and no clock. Thread-bound.
class RtuFramer {
 public:
  /// Unit, protocol data unit of 253 bytes at most, checksum.
  static constexpr std::size_t kLongestFrame = 256;
  static constexpr int kBroadcast = 0;

  /// Pauses from `pause` on end what is no frame for us.
  RtuFramer(int unit_id, hal::Clock::duration pause) : unit_id_(unit_id), pause_(pause) {}

  /// `bytes`, at most kLongestFrame, came `silence` after those before them. To be called only
  /// when next() has returned none.
  void push(std::span<const std::uint8_t> bytes, hal::Clock::duration silence);

  /// The next whole frame for the unit or for all, with its checksum, which is right; none when
  /// there is none yet. What it returned before is gone.
  std::optional<std::span<const std::uint8_t>> next();

  /// How often something was thrown away that was no frame.
  std::uint64_t broken() const { return broken_; }

  /// Whole frames for other units, and theirs.
  std::uint64_t for_others() const { return for_others_; }

 private:
  std::span<const std::uint8_t> bytes() const { return std::span(buffer_).first(size_); }
  bool is_for_us(std::uint8_t unit) const { return unit == unit_id_ || unit == kBroadcast; }
  std::optional<std::size_t> frame_length(std::span<const std::uint8_t> bytes) const;
  void begin_again();
  void drop(std::size_t count);

  const int unit_id_;
  const hal::Clock::duration pause_;
  std::array<std::uint8_t, 2 * kLongestFrame> buffer_{};
  std::size_t size_ = 0;
  std::size_t handed_out_ = 0;   ///< at the beginning: what next() has returned
  std::size_t after_pause_ = 0;  ///< where in the buffer the last pause was; 0: nowhere
  bool is_lost_ = false;         ///< until the next pause
  std::uint64_t broken_ = 0;
  std::uint64_t for_others_ = 0;
};

/// The pause that ends a frame: 3.5 characters of 11 bits, above 19200 bit/s 1.75 ms.
constexpr hal::Clock::duration rtu_pause(int baud_rate) {
  using std::chrono::microseconds;
  return baud_rate > 19200 ? microseconds(1750) : microseconds(38'500'000 / baud_rate);
}

}  // namespace orbwatch::app::modbus
