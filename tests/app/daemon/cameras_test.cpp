#include "app/daemon/cameras.h"

#include <gtest/gtest.h>

namespace orbwatch::app {
namespace {

/// Shows what is requested of it.
class RequestedCamera : public hal::Camera {
 public:
  RequestedCamera() : Camera({"requested", "requested", "test"}) {}

  hal::StreamRequest requested;

 private:
  Result<hal::StreamFormat> do_configure(const hal::StreamRequest& request) override {
    requested = request;
    return hal::StreamFormat{PixelFormat::Grey, {}, 8, 8, 10};
  }
  void run(const std::stop_token&) override {}
};

std::size_t requested_buffers(hal::TriggerMode mode) {
  Resolved site;
  site.site.cameras.emplace_back().trigger.mode = mode;
  optics::RigCamera& rig = site.rig.cameras.emplace_back();
  rig.width = rig.height = 8;
  site.rig_cameras = {0};
  RequestedCamera camera;
  const auto format = open_camera(camera, site, 0);
  EXPECT_TRUE(format) << format.error().detail;
  return camera.requested.buffers;
}

TEST(OpenCamera, ATriggeredCameraHasBuffersForAFullQueue) {
  EXPECT_EQ(requested_buffers(hal::TriggerMode::Line), hal::kTriggeredBuffers);
  EXPECT_EQ(requested_buffers(hal::TriggerMode::Off), hal::kFreeRunningBuffers);
}

}  // namespace
}  // namespace orbwatch::app
