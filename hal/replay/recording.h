// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

#include "hal/camera.h"
#include "hal/fault.h"
#include "hal/frame/frame.h"

namespace orbwatch::hal {

/// Exposure of a recorded picture.
struct RecordedMoment {
  std::chrono::nanoseconds offset{0};  ///< since the start of the recording
  std::uint64_t sequence = 0;          ///< see FrameMetadata
  std::optional<std::uint64_t> trigger = std::nullopt;
  std::uint64_t set_time = 0;  ///< see FrameMetadata::recorded_set
};

/// Recorded pictures by number. Thread-bound.
class Recording {
 public:
  Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  virtual ~Recording() = default;

  /// Size and format of every picture, and the recorded rate; 0: unknown.
  virtual const StreamFormat& format() const = 0;

  /// Addition to a message on its size: see exif_note().
  virtual std::string size_note() const { return {}; }

  /// Recorded exposure of picture `number`, or of one that would follow the last; a looped
  /// recording goes on. nullopt: pictures come at the rate.
  virtual std::optional<RecordedMoment> moment(std::uint64_t /*number*/) const {
    return std::nullopt;
  }

  /// Copies the pixels of picture `number` into `target`, which has the recording's size and
  /// format, and sets its status if the picture is flawed. A looped recording shows number modulo
  /// count. Faults: CorruptFrame or WrongFormat, for this picture only; Unplugged at the
  /// recording's end; any fault once `stop` is requested.
  virtual DeviceResult<> show(std::uint64_t number, FrameBuffer& target,
                              const std::stop_token& stop) = 0;
};

}  // namespace orbwatch::hal
