#pragma once

#include <libcamera/controls.h>

#include <atomic>
#include <mutex>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// Controls that were set, on their way to the camera. Thread-safe.
class ControlSettings {
 public:
  ControlSettings();

  /// Remembers a setting; see put_control().
  Result<> set(const libcamera::ControlInfoMap& offered, std::string_view name, double value);

  /// Everything that was ever set, for a camera that starts.
  libcamera::ControlList all();

  /// Adds to a request what was set since the last call, or since all().
  void add_changes(libcamera::ControlList& request);

 private:
  std::atomic<bool> changed_{false};  ///< spares the frame path the lock
  std::mutex mutex_;
  libcamera::ControlList all_;
  libcamera::ControlList changes_;
};

}  // namespace orbwatch::hal
