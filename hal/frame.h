#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "hal/clock.h"
#include "proc/image/picture.h"

namespace orbwatch::hal {

/// The moment that a camera's time stamps tell.
enum class StampSource : std::uint8_t {
  ExposureStart,
  FrameEnd,  ///< the last pixel arrived: later by exposure and readout, which are not known
  Arrival,   ///< the camera's thread took the frame: the camera itself gave no stamp
};

/// What a camera says about one frame.
struct FrameMetadata {
  std::uint64_t sequence = 0;  ///< counts exposures since start; a gap is a lost frame
  TimePoint exposure_start;    ///< when the exposure began, as near as stamp_source comes
  StampSource stamp_source = StampSource::ExposureStart;
  std::chrono::microseconds exposure_time{0};  ///< 0: not known
  double gain = 1.0;                           ///< linear, analogue times digital
  /// Number of the hardware trigger that began the exposure: rising, and the same for all cameras
  /// that it started. None: the camera runs freely.
  std::optional<std::uint64_t> trigger = std::nullopt;
  double lux = 0;  ///< illuminance of the scene as the camera estimates it; 0: not known
};

/// One picture in a buffer of a camera. Filled by the camera's thread, then never changed again.
/// The memory belongs to the camera's pool and goes back to it with the last Frame that names it.
struct FrameBuffer {
  Picture picture;
  FrameMetadata metadata;
  std::byte* memory =
      nullptr;  ///< start of the buffer behind the picture; null where only a device writes
  std::size_t capacity = 0;              ///< its size in bytes
  std::unique_ptr<std::byte[]> storage;  ///< owns the memory, unless that is a driver's
};

/// A frame on its way through the product: shared, read-only. Releasing the last one returns the
/// buffer to its camera; safe on any thread, also after the camera stopped or went away.
using Frame = std::shared_ptr<const FrameBuffer>;

}  // namespace orbwatch::hal
