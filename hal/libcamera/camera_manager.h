// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libcamera/camera_manager.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// A share in the process's CameraManager, of which libcamera allows one: the first share starts
/// it, the end of the last one stops it. Error: libcamera does not start. Thread-safe.
Result<std::shared_ptr<libcamera::CameraManager>> camera_manager();

/// A camera that libcamera found.
struct ListedCamera {
  std::string id;
  std::string model;  ///< model of the sensor
};

/// Cameras that libcamera lists now. Thread-safe.
std::vector<ListedCamera> list_cameras(const libcamera::CameraManager& manager);

/// The sensor's own name, or "unknown".
std::string model_of(const libcamera::Camera& camera);

/// Id of the camera that `wanted` names: its whole id, or a part of id or model that only one of
/// `cameras` has; "" selects the only camera. The error lists the cameras found. Reentrant.
Result<std::string> choose_camera(const std::vector<ListedCamera>& cameras,
                                  std::string_view wanted);

/// Reports a camera's removal during its own lifetime. `on_removed` is called on libcamera's thread
/// and must return at once.
class RemovalWatch {
 public:
  RemovalWatch(std::shared_ptr<const libcamera::Camera> camera, std::function<void()> on_removed);
  RemovalWatch(const RemovalWatch&) = delete;
  RemovalWatch& operator=(const RemovalWatch&) = delete;
  ~RemovalWatch();

  /// Called for each removed camera.
  void notify(const libcamera::Camera* removed) const;

 private:
  std::shared_ptr<const libcamera::Camera> camera_;
  std::function<void()> on_removed_;
};

/// True when a device node of the camera has vanished. Only libcamera's pipeline of USB cameras
/// detects that; libcamera 0.4 aborts the process when such a camera of another pipeline is
/// stopped, destroyed or connected again. False if libcamera lists no nodes.
bool has_lost_its_nodes(const libcamera::Camera& camera);

}  // namespace orbwatch::hal
