// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "hal/camera.h"
#include "hal/frame/frame_pool.h"
#include "hal/test_pattern/test_pattern_settings.h"

namespace orbwatch::hal {

/// Delivers noisy pictures with a bright disc that were drawn before the start: the remaining load,
/// apart from the optional number, is that of the readers. Exposure n is at start + n / rate on the
/// steady clock; it is lost, a gap in the sequence, when all buffers are lent.
class TestPatternCamera : public Camera {
 public:
  explicit TestPatternCamera(TestPatternSettings settings);
  ~TestPatternCamera() override;

 protected:
  /// Errors: no size, or one that the format does not permit.
  Result<StreamFormat> do_configure(const StreamRequest& request) override;
  ThreadRole role() const override { return ThreadRole::Service; }
  void run(const std::stop_token& stop) override;

 private:
  TestPatternSettings settings_;
  FaultScript script_;
  StreamFormat format_;
  std::optional<FramePool> pool_;
};

}  // namespace orbwatch::hal
