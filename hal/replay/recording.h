#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <tl/expected.hpp>

#include "hal/camera.h"
#include "hal/fault.h"
#include "hal/frame/frame.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// A value, or the fault to report.
template <class T = void>
using Shown = tl::expected<T, FaultReport>;

/// Recorded pictures by number. Thread-bound.
class Recording {
 public:
  Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  virtual ~Recording() = default;

  /// Size and format of every picture, and the recorded rate; 0: unknown.
  virtual const StreamFormat& format() const = 0;

  /// Copies the pixels of picture `number` into `target`, which has the recording's size and
  /// format. A looped recording shows number modulo count. Faults: CorruptFrame or WrongFormat, for
  /// this picture only; Unplugged at the recording's end; any fault once `stop` is requested.
  virtual Shown<> show(std::uint64_t number, FrameBuffer& target, const std::stop_token& stop) = 0;
};

/// Opens a folder of pictures or a video file. Errors: neither, empty, cannot be decoded.
Result<std::unique_ptr<Recording>> open_recording(const std::filesystem::path& source, bool loop);

}  // namespace orbwatch::hal
