// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "hal/clock.h"
#include "proc/image/picture.h"

namespace orbwatch::hal {

/// Event that a camera's time stamps mark.
enum class StampSource : std::uint8_t {
  ExposureStart,
  ReadoutStart,  ///< arrival of the first pixel: later by the exposure time
  FrameEnd,      ///< arrival of the last pixel: later by exposure and readout time
  Arrival,       ///< dequeued by the camera's thread: the camera gave no stamp
};

/// Usability of a frame.
enum class FrameStatus : std::uint8_t {
  Intact,
  Flawed,    ///< complete; its JPEG data drew a warning: see JpegDecoder::is_flawed()
  Withheld,  ///< damaged, or intact between damaged ones: see DamageWatch; never delivered
};

/// Data that a camera states about one frame.
struct FrameMetadata {
  std::uint64_t sequence = 0;  ///< counts exposures since start; a gap is a lost frame
  TimePoint exposure_start;    ///< start of the first row's exposure; back-ends put the stamp here:
                               ///< see exposure_start()
  StampSource stamp_source = StampSource::ExposureStart;  ///< event that the camera's stamp marked
  std::chrono::microseconds exposure_time{0};             ///< 0: unknown
  double gain = 1.0;                                      ///< linear gain, analogue times digital
  /// Number of the hardware trigger that began the exposure: rising, and the same for all cameras
  /// that it started. None: the camera runs freely.
  std::optional<std::uint64_t> trigger = std::nullopt;
  /// Stamp of the frame set that a replayed frame was recorded in, ns of UTC since 1970; 0: it is
  /// of no recording.
  std::uint64_t recorded_set = 0;
  /// The exposure has every control that was set before this moment: see ControlDelay.
  TimePoint controls_as_of{};
  /// Name of a control whose stated value differs from the one that was set; static.
  const char* not_as_set = nullptr;
  double lux = 0;  ///< camera's estimate of the scene's illuminance; 0: unknown
  FrameStatus status = FrameStatus::Intact;
};

/// One picture in a camera's buffer: filled by the camera's thread, then immutable. The memory
/// belongs to the camera's pool and returns to it with the last Frame.
struct FrameBuffer {
  Picture picture;
  /// The data that the picture was decoded from, as the camera sent it, if
  /// StreamRequest::keeps_jpeg requested it; else empty. Lives as long as the frame.
  std::span<const std::byte> jpeg;
  FrameMetadata metadata;
  std::byte* memory =
      nullptr;  ///< start of the buffer behind the picture; null where only a device writes
  std::size_t capacity = 0;              ///< size of the buffer in bytes
  std::unique_ptr<std::byte[]> storage;  ///< owns the memory, unless it belongs to a driver
};

/// Frame on its way through the product: shared, read-only. Releasing the last one returns the
/// buffer to its camera; safe on any thread, also after the camera's stop or end.
using Frame = std::shared_ptr<const FrameBuffer>;

}  // namespace orbwatch::hal
