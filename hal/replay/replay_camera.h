// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/camera.h"
#include "hal/fault.h"
#include "hal/frame/frame_pool.h"
#include "hal/replay/recording.h"
#include "hal/replay/replay_settings.h"

namespace orbwatch::hal {

/// Camera that plays a recording. Exposure n is due at start + n / rate and shows picture n modulo
/// count, so cameras that start together stay synchronous. When late by a period or more, it skips
/// exposures, a gap in the sequence, as when all buffers are lent. A recording with moments of its
/// own is played at these, and skips none until it is late by a second. A damaged picture is
/// withheld and counted; one that differs from the first in size or format is withheld and
/// reported.
class ReplayCamera : public Camera {
 public:
  explicit ReplayCamera(ReplaySettings settings);
  ~ReplayCamera() override;

  std::string format_note() const override;

 protected:
  /// Opens the recording. A requested rate precedes the settings'. Errors: no folder of pictures or
  /// video, empty, cannot be decoded; another size than requested; a rate above kMaxFrameRate.
  Result<StreamFormat> do_configure(const StreamRequest& request) override;
  ThreadRole role() const override { return ThreadRole::Service; }
  void run(const std::stop_token& stop) override;

 private:
  RecordedMoment moment(std::uint64_t number) const;
  std::uint64_t next(std::uint64_t number, Clock::duration elapsed) const;
  bool expose(std::uint64_t number, TimePoint start, const std::stop_token& stop);

  ReplaySettings settings_;
  FaultScript script_;
  StreamFormat format_;
  std::unique_ptr<Recording> recording_;
  std::optional<FramePool> pool_;
};

}  // namespace orbwatch::hal
