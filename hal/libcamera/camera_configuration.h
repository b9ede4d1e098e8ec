#pragma once

#include <libcamera/camera.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "hal/camera.h"
#include "hal/device_result.h"
#include "hal/libcamera/libcamera_format.h"
#include "hal/libcamera/sensor_mode.h"

namespace orbwatch::hal {

/// A camera that this process has for itself, until the end of this object.
class AcquiredCamera {
 public:
  /// Faults: another process has it, it was unplugged.
  static DeviceResult<AcquiredCamera> acquire(std::shared_ptr<libcamera::Camera> camera);
  AcquiredCamera(AcquiredCamera&& other) noexcept = default;
  AcquiredCamera& operator=(AcquiredCamera&&) = delete;
  ~AcquiredCamera();

  libcamera::Camera& operator*() const { return *camera_; }
  libcamera::Camera* operator->() const { return camera_.get(); }
  const std::shared_ptr<libcamera::Camera>& share() const { return camera_; }

 private:
  explicit AcquiredCamera(std::shared_ptr<libcamera::Camera> camera) : camera_(std::move(camera)) {}

  std::shared_ptr<libcamera::Camera> camera_;
};

/// What a camera agreed to deliver.
struct LibcameraAgreement {
  std::unique_ptr<libcamera::CameraConfiguration> configuration;  ///< of the camera now
  const LibcameraFormat* pixels = nullptr;                        ///< in kLibcameraFormats
  StreamFormat stream;                                            ///< frame rate 0: not known
  std::size_t stride = 0;                                         ///< of the first plane, bytes

  const libcamera::StreamConfiguration& picture() const { return configuration->at(0); }
};

/// In which respect, size or pixel format, validate() made another stream of what was asked for, as
/// text; nothing if in none. Buffer count, stride and colour space are libcamera's to choose.
std::optional<std::string> difference(const libcamera::StreamConfiguration& asked,
                                      const libcamera::StreamConfiguration& given);

/// Configures a camera. `preference` is a name of kLibcameraFormats or "auto": the first that the
/// camera delivers in the size and mode asked for. Size and mode are honoured or refused; the rate
/// is the possible one nearest to what was asked for. The error names what the camera offers.
Result<LibcameraAgreement> agree_on_configuration(libcamera::Camera& camera,
                                                  std::string_view preference,
                                                  const SensorMode& mode,
                                                  const StreamRequest& request);

/// Puts the frame rate of an agreement among the controls for the camera's start, unless it is 0.
void put_frame_rate(double frame_rate, libcamera::ControlList& controls);

}  // namespace orbwatch::hal
