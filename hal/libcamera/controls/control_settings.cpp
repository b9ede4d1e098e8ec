#include "hal/libcamera/controls/control_settings.h"

#include <libcamera/control_ids.h>

#include "hal/libcamera/controls/libcamera_controls.h"

namespace orbwatch::hal {

ControlSettings::ControlSettings()
    : all_(libcamera::controls::controls), changes_(libcamera::controls::controls) {}

Result<> ControlSettings::set(const libcamera::ControlInfoMap& offered, std::string_view name,
                              double value) {
  const std::lock_guard lock(mutex_);
  if (auto put = put_control(offered, name, value, all_); !put) return put;
  const unsigned id = find_control(offered, name)->id();
  changes_.set(id, all_.get(id));
  changed_ = true;
  return {};
}

libcamera::ControlList ControlSettings::all() {
  const std::lock_guard lock(mutex_);
  changes_.clear();
  changed_ = false;
  return all_;
}

void ControlSettings::add_changes(libcamera::ControlList& request) {
  if (!changed_) return;
  const std::lock_guard lock(mutex_);
  for (const auto& [id, value] : changes_) request.set(id, value);
  changes_.clear();
  changed_ = false;
}

}  // namespace orbwatch::hal
