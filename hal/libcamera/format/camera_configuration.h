// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libcamera/camera.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "hal/camera.h"
#include "hal/fault.h"
#include "hal/libcamera/format/libcamera_format.h"
#include "hal/libcamera/libcamera_settings.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Text such as "1640x1232 10 bit".
std::string to_text(const SensorMode& mode);

/// Bits per sample of a raw format, packed or not, or 0 for other formats.
int raw_bit_depth(libcamera::PixelFormat format);

/// A camera's modes as text: "1640x1232 10 bit, 3280x2464 10 bit", or "none".
std::string sensor_modes_of(libcamera::Camera& camera);

/// A configuration for video, not validated yet, whose first stream is the picture and which
/// requests `mode` if it is set. Error: the camera's mode cannot be chosen.
Result<std::unique_ptr<libcamera::CameraConfiguration>> begin_configuration(
    libcamera::Camera& camera, const SensorMode& mode);

/// True if a configuration of begin_configuration() still has the mode after validate().
bool has_sensor_mode(const libcamera::CameraConfiguration& validated, const SensorMode& mode);

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

/// Configuration that a camera will deliver.
struct NegotiatedConfiguration {
  std::unique_ptr<libcamera::CameraConfiguration> configuration;  ///< the camera's current one
  const LibcameraFormat* pixels = nullptr;                        ///< entry in kLibcameraFormats
  StreamFormat stream;                                            ///< frame rate 0: unknown
  std::size_t stride = 0;             ///< stride of the first plane, bytes
  std::size_t requested_buffers = 0;  ///< a pipeline may make fewer

  const libcamera::StreamConfiguration& picture() const { return configuration->at(0); }
};

/// Changes by validate() to the requested size or pixel format, as text; nullopt if none. Buffer
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
