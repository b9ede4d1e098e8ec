#pragma once

#include <libcamera/controls.h>

#include <atomic>
#include <mutex>
#include <string_view>
#include <vector>

#include "hal/inventory.h"
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

/// libcamera's id of the control `name`, as in put_control(), or nullptr.
const libcamera::ControlId* find_control(const libcamera::ControlInfoMap& offered,
                                         std::string_view name);

/// The controls of put_control(), by name.
std::vector<CameraControl> list_controls(const libcamera::ControlInfoMap& offered);

/// Controls that are set, until they reach the camera. Thread-safe.
class ControlSettings {
 public:
  ControlSettings();

  /// Stores a setting; see put_control().
  Result<> set(const libcamera::ControlInfoMap& offered, std::string_view name, double value);

  /// Every control that was set, for a camera's start.
  libcamera::ControlList all();

  /// The first control that was set to another value than a frame's metadata state, or nullptr. Of
  /// exposure, gains and colour gains, which are fixed and which metadata state as the sensor
  /// rounded them.
  const libcamera::ControlId* find_other(const libcamera::ControlList& metadata) const;

  /// Adds the settings since the last call, or since all(), to a request.
  void add_changes(libcamera::ControlList& request);

 private:
  std::atomic<bool> changed_{false};  ///< spares the frame path the lock
  mutable std::mutex mutex_;
  libcamera::ControlList all_;
  libcamera::ControlList changes_;
};

}  // namespace orbwatch::hal
