// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libcamera/controls.h>

#include <atomic>
#include <mutex>
#include <string_view>
#include <vector>

#include "hal/inventory.h"
#include "hal/thread/priority_mutex.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Puts a control into `list`, by libcamera's name and unit (ExposureTime in microseconds,
/// AnalogueGain, AeEnable and other switches as 0 or 1, LensPosition in dioptres, ...) or by a
/// GenICam name: Gain, ExposureAuto, BalanceWhiteAuto. ColourGains[0] and ColourGains[1] are the
/// gains of red and blue; one that was never set is 1. Values of integer controls are rounded.
/// Errors: no such control in `offered` (with a list of the existing ones), not a number, out of
/// range.
Result<> put_control(const libcamera::ControlInfoMap& offered, std::string_view name, double value,
                     libcamera::ControlList& list);

/// Libcamera's id of the control `name`, as in put_control(), or nullptr.
const libcamera::ControlId* find_control(const libcamera::ControlInfoMap& offered,
                                         std::string_view name);

/// Controls that put_control() accepts, by name.
std::vector<CameraControl> list_controls(const libcamera::ControlInfoMap& offered);

/// Settings of controls that have not reached the camera yet. Thread-safe.
class ControlSettings {
 public:
  ControlSettings();

  /// Stores a setting; see put_control().
  Result<> set(const libcamera::ControlInfoMap& offered, std::string_view name, double value);

  /// All controls that were set, for a camera's start.
  libcamera::ControlList all();

  /// First control whose value in a frame's metadata differs from the one that was set, or nullptr.
  /// Considers fixed exposure, gains and colour gains, which metadata state as the sensor rounded
  /// them.
  const libcamera::ControlId* find_other(const libcamera::ControlList& metadata) const;

  /// Adds the settings since the last call, or since all(), to a request.
  void add_changes(libcamera::ControlList& request);

 private:
  std::atomic<bool> changed_{false};  ///< true while changes_ holds settings for the next request
  mutable PriorityMutex mutex_;
  libcamera::ControlList all_;
  libcamera::ControlList changes_;
};

}  // namespace orbwatch::hal
