#pragma once

#include <libcamera/camera.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "hal/camera.h"
#include "hal/fault.h"
#include "hal/libcamera/format/libcamera_format.h"
#include "hal/libcamera/format/sensor_mode.h"

namespace orbwatch::hal {

/// Exclusive access to a camera, until the end of this object.
class AcquiredCamera {
 public:
  /// Faults: in use by another process, unplugged.
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

/// What a camera will deliver.
struct NegotiatedConfiguration {
  std::unique_ptr<libcamera::CameraConfiguration> configuration;  ///< the camera's current one
  const LibcameraFormat* pixels = nullptr;                        ///< in kLibcameraFormats
  StreamFormat stream;                                            ///< frame rate 0: unknown
  std::size_t stride = 0;                                         ///< of the first plane, bytes

  const libcamera::StreamConfiguration& picture() const { return configuration->at(0); }
};

/// How validate() changed the requested size or pixel format, as text; nullopt if not. Buffer
/// count, stride and colour space are libcamera's choice.
std::optional<std::string> difference(const libcamera::StreamConfiguration& asked,
                                      const libcamera::StreamConfiguration& given);

/// Configures a camera. `preference` is a name of kLibcameraFormats or "auto": the first that the
/// camera delivers in the requested size and mode. Size and mode are honoured or refused; the rate
/// is the nearest possible one. The error lists the camera's offers.
Result<NegotiatedConfiguration> negotiate_configuration(libcamera::Camera& camera,
                                                        std::string_view preference,
                                                        const SensorMode& mode,
                                                        const StreamRequest& request);

/// Adds a negotiated frame rate to the controls of the camera's start, unless it is 0.
void put_frame_rate(double frame_rate, libcamera::ControlList& controls);

}  // namespace orbwatch::hal
