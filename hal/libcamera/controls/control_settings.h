#pragma once

#include <libcamera/controls.h>

#include <atomic>
#include <mutex>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// Controls that are set, until they reach the camera. Thread-safe.
class ControlSettings {
 public:
  ControlSettings();

  /// Stores a setting; see put_control().
  Result<> set(const libcamera::ControlInfoMap& offered, std::string_view name, double value);

  /// Every control that was set, for a camera's start.
  libcamera::ControlList all();

  /// Adds the settings since the last call, or since all(), to a request.
  void add_changes(libcamera::ControlList& request);

 private:
  std::atomic<bool> changed_{false};  ///< spares the frame path the lock
  std::mutex mutex_;
  libcamera::ControlList all_;
  libcamera::ControlList changes_;
};

}  // namespace orbwatch::hal
