// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/clock.h"

namespace orbwatch::app::modbus {

/// Splits the bytes of a serial line into the Modbus RTU frames for one unit (Modbus over Serial
/// Line V1.02, 2.5.1). Frames of other units and frames with a wrong checksum are skipped, as the
/// standard requires.
///
/// By the standard a frame ends with a pause of 3.5 characters. USB adapters deliver one frame in
/// pieces with longer pauses, or two frames in one piece. So a frame ends at the length given by
/// its function code, or else where its checksum matches; a pause only marks a possible start of
/// the next frame after an error. Bytes that are not a frame are kept until the line is silent: a
/// master that waits for its answer has sent its request last, whatever preceded it. Independent of
/// devices and clocks. Thread-bound.
class RtuFramer {
 public:
  /// Length of unit, protocol data unit (at most 253 bytes) and checksum.
  static constexpr std::size_t kLongestFrame = 256;
  static constexpr int kBroadcast = 0;

  /// The longest gap inside a frame. Adapters pause for up to 16 ms; masters repeat a request after
  /// 100 ms or more.
  static constexpr std::chrono::milliseconds kMaxGap{50};

  /// `pause`: shortest silence that counts as a pause.
  RtuFramer(int unit_id, hal::Clock::duration pause) : unit_id_(unit_id), pause_(pause) {}

  /// Appends `bytes`, at most kLongestFrame, that arrived `silence` after those before. Only when
  /// next() returned nullopt.
  void push(std::span<const std::uint8_t> bytes, hal::Clock::duration silence);

  /// The next complete frame for the unit or a broadcast, with a valid checksum; nullopt: none yet.
  /// Invalidates the frame returned before.
  std::optional<std::span<const std::uint8_t>> next();

  /// Returns whether bytes wait for the rest of their frame, or for a silence.
  bool is_waiting() const { return size_ > returned_; }

  /// Reports that the line was silent for kMaxGap: waiting bytes will not be continued. next()
  /// returns the request at their end, if there is one; the rest is dropped. One stray byte may
  /// follow the request. A frame for this unit inside the bytes of another frame is not at the end,
  /// because that frame's checksum follows. Only when next() returned nullopt.
  void end();

  /// Number of times that bytes were dropped because they were not a frame.
  std::uint64_t errors() const { return errors_; }

  /// Number of complete frames to and from other units.
  std::uint64_t other_units() const { return other_units_; }

 private:
  /// The bytes after those known not to be a frame.
  std::span<const std::uint8_t> bytes() const {
    return std::span(buffer_).first(size_).subspan(spoilt_);
  }
  bool is_for_us(std::uint8_t unit) const { return unit == unit_id_ || unit == kBroadcast; }
  std::optional<std::size_t> frame_length(std::span<const std::uint8_t> bytes) const;
  std::optional<std::span<const std::uint8_t>> last_request() const;
  void resynchronise();
  void spoil(std::size_t count);
  void drop(std::size_t count);

  const int unit_id_;
  const hal::Clock::duration pause_;
  std::array<std::uint8_t, 3 * kLongestFrame> buffer_{};
  std::size_t size_ = 0;
  std::size_t spoilt_ = 0;       ///< bytes at the front that are not a frame, kept for end()
  std::size_t returned_ = 0;     ///< length of the frame at the front that next() returned
  std::size_t after_pause_ = 0;  ///< index of the last pause in bytes(); 0: none
  bool is_lost_ = false;         ///< bytes are not a frame until the next pause
  std::uint64_t errors_ = 0;
  std::uint64_t other_units_ = 0;
};

/// Pause that ends a frame: 3.5 characters of 11 bits, 1.75 ms above 19200 bit/s.
constexpr hal::Clock::duration rtu_pause(int baud_rate) {
  using std::chrono::microseconds;
  return baud_rate > 19200 ? microseconds(1750) : microseconds(38'500'000 / baud_rate);
}

}  // namespace orbwatch::app::modbus
