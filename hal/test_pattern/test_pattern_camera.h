#pragma once

#include <optional>

#include "hal/camera.h"
#include "hal/frame/frame_pool.h"
#include "hal/test_pattern/test_pattern_settings.h"

namespace orbwatch::hal {

/// Delivers noisy pictures with a bright disc, which were drawn before the start: what remains, but
/// for the number if that is asked for, is the work of those who read them. Exposure n is at start
/// + n / rate on the steady clock; it is lost, a gap in the sequence, when all buffers are lent.
class TestPatternCamera : public Camera {
 public:
  explicit TestPatternCamera(TestPatternSettings settings);
  ~TestPatternCamera() override;

 protected:
  /// Errors: no size, or one that the format cannot have.
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
