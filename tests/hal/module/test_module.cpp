// SPDX-License-Identifier: Apache-2.0
#include <sstream>

#include "hal/module/camera_module.h"
#include "hal/thread/scheduling.h"

#ifdef ORBWATCH_TEST_UNRESOLVED
extern "C" int orbwatch_function_of_a_library_that_is_missing();
#endif

namespace orbwatch::hal {
namespace {

/// Delivers one frame of one pixel.
class OnePixelCamera : public Camera {
 public:
  explicit OnePixelCamera(const CameraContext& context)
      : Camera({context.name, "one pixel", "test"}) {}
  ~OnePixelCamera() override { stop(); }

 protected:
  Result<StreamFormat> do_configure(const StreamRequest&) override {
    return StreamFormat{PixelFormat::Grey, {}, 1, 1, 1};
  }
  void run(const std::stop_token&) override {
    auto frame = std::make_shared<FrameBuffer>();
    frame->metadata.sequence = 7;
    deliver(std::move(frame));
  }
};

std::vector<CameraEntry> list_cameras() {
  std::ostringstream address;
  address << reinterpret_cast<const void*>(&schedule_this_thread);
  CameraEntry entry;
  entry.id = address.str();
#ifdef ORBWATCH_TEST_UNRESOLVED
  entry.id += std::to_string(orbwatch_function_of_a_library_that_is_missing());
#endif
  return {entry};
}

const CameraModule kModule{
    ORBWATCH_TEST_INTERFACE,
    ORBWATCH_TEST_BUILD_ID,
    "libcamera",
    [](const void*, const CameraContext& context) -> std::unique_ptr<Camera> {
      return std::make_unique<OnePixelCamera>(context);
    },
    list_cameras,
    [] { return std::string("1.0"); }};

}  // namespace
}  // namespace orbwatch::hal

extern "C" const orbwatch::hal::CameraModule* orbwatch_camera_module() {
  return &orbwatch::hal::kModule;
}
