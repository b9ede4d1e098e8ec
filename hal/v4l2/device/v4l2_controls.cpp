// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/device/v4l2_controls.h"

#include <linux/v4l2-controls.h>

#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <sstream>

namespace orbwatch::hal {
namespace {

/// GenICam name (SFNC 2.7) for a control of V4L2.
struct Alias {
  std::string_view name;
  std::uint32_t id;
  double units;  ///< V4L2's units per GenICam unit
};

/// Unit of V4L2_CID_EXPOSURE_ABSOLUTE.
constexpr std::chrono::microseconds kExposureUnit{100};

constexpr std::array kAliases{
    Alias{"ExposureTime", V4L2_CID_EXPOSURE_ABSOLUTE, 1.0 / kExposureUnit.count()},
    Alias{"ExposureAuto", V4L2_CID_EXPOSURE_AUTO, 1},
    Alias{"Gain", V4L2_CID_GAIN, 1},
    Alias{"GainAuto", V4L2_CID_AUTOGAIN, 1},
    Alias{"BalanceWhiteAuto", V4L2_CID_AUTO_WHITE_BALANCE, 1},
};

constexpr std::uint32_t kNotSettable = V4L2_CTRL_FLAG_INACTIVE | V4L2_CTRL_FLAG_GRABBED;

const Alias* alias_of(std::string_view name) {
  for (const Alias& alias : kAliases) {
    if (alias.name == name) return &alias;
  }
  return nullptr;
}

/// A name without separators.
std::string letters_of(std::string_view name) {
  std::string letters = control_variable(name);
  std::erase(letters, '_');
  return letters;
}

/// V4L2's menu entry for GenICam's ExposureAuto: off, or the automatic mode that the camera has.
Result<double> exposure_entry(const V4l2Device& device, const v4l2_query_ext_ctrl& control,
                              double value) {
  if (value == 0) return V4L2_EXPOSURE_MANUAL;
  for (const int mode : {V4L2_EXPOSURE_AUTO, V4L2_EXPOSURE_APERTURE_PRIORITY}) {
    if (value == 1 && device.menu_entry(control, mode)) return mode;
  }
  return fail("control ExposureAuto takes 0 (off) and 1 (on)");
}

/// A value in V4L2's units.
Result<double> in_units(const V4l2Device& device, const v4l2_query_ext_ctrl& control,
                        const Alias* alias, double value) {
  if (alias == nullptr) return std::round(value);
  if (alias->id == V4L2_CID_EXPOSURE_AUTO) return exposure_entry(device, control, value);
  return std::round(value * alias->units);
}

Result<> check(const v4l2_query_ext_ctrl& control, double units) {
  const std::string name = control_variable(control.name);
  if (!takes_number(control)) return fail("control " + name + " does not take a number");
  if ((control.flags & V4L2_CTRL_FLAG_READ_ONLY) != 0) {
    return fail("control " + name + " is read only");
  }
  if ((control.flags & kNotSettable) != 0) {
    return fail("control " + name + " cannot be set now; switch automatic control off first");
  }
  if (control.type == V4L2_CTRL_TYPE_BUTTON) return {};
  if (!(units >= static_cast<double>(control.minimum) &&
        units <= static_cast<double>(control.maximum))) {
    std::ostringstream message;
    message << "control " << name << " cannot be " << units << "; it takes " << control.minimum
            << " to " << control.maximum;
    return fail(message.str());
  }
  return {};
}

}  // namespace

bool takes_number(const v4l2_query_ext_ctrl& control) {
  switch (control.type) {
    case V4L2_CTRL_TYPE_INTEGER:
    case V4L2_CTRL_TYPE_BOOLEAN:
    case V4L2_CTRL_TYPE_MENU:
    case V4L2_CTRL_TYPE_BUTTON:
    case V4L2_CTRL_TYPE_INTEGER_MENU:
    case V4L2_CTRL_TYPE_INTEGER64:
    case V4L2_CTRL_TYPE_BITMASK:
      return control.nr_of_dims == 0;
    default:
      return false;
  }
}

std::string control_variable(std::string_view name) {
  std::string variable;
  bool gap = false;
  for (const char letter : name) {
    const auto c = static_cast<unsigned char>(letter);
    if (std::isalnum(c) == 0) {
      gap = !variable.empty();
      continue;
    }
    if (gap) variable += '_';
    gap = false;
    variable += static_cast<char>(std::tolower(c));
  }
  return variable;
}

Result<v4l2_query_ext_ctrl> find_control(const V4l2Device& device, std::string_view name) {
  const Alias* const alias = alias_of(name);
  const std::string letters = letters_of(name);
  std::string known;
  std::optional<v4l2_query_ext_ctrl> control = device.next_control(0);
  for (; control; control = device.next_control(control->id)) {
    if (alias != nullptr ? control->id == alias->id : letters_of(control->name) == letters) {
      return *control;
    }
    if (takes_number(*control)) {
      known += (known.empty() ? "" : ", ") + control_variable(control->name);
    }
  }
  return fail("no control \"" + std::string(name) +
              "\"; there are: " + (known.empty() ? "none" : known));
}

Result<> set_control(V4l2Device& device, std::string_view name, double value) {
  const auto named = [&device](const std::string& message) {
    return fail(device.path() + ": " + message);
  };
  const auto control = find_control(device, name);
  if (!control) return named(control.error().message);
  const auto units = in_units(device, *control, alias_of(name), value);
  if (!units) return named(units.error().message);
  if (auto good = check(*control, *units); !good) return named(good.error().message);
  // A button ignores the value, which need not be a number.
  const bool button = control->type == V4L2_CTRL_TYPE_BUTTON;
  const std::int64_t number = button ? 0 : static_cast<std::int64_t>(*units);
  if (auto done = device.set_control(*control, number); !done) return fail(done.error().detail);
  return {};
}

bool is_inactive(const V4l2Device& device, std::string_view name) {
  const auto control = find_control(device, name);
  return control && (control->flags & kNotSettable) != 0;
}

bool is_button(const V4l2Device& device, std::string_view name) {
  const auto control = find_control(device, name);
  return control && control->type == V4L2_CTRL_TYPE_BUTTON;
}

std::chrono::microseconds exposure_time(const V4l2Device& device) {
  const auto control = find_control(device, "ExposureTime");
  if (!control || (control->flags & V4L2_CTRL_FLAG_INACTIVE) != 0) return {};
  return device.control(*control).value_or(0) * kExposureUnit;
}

bool waits_for_trigger(const V4l2Device& device) {
  const auto control = find_control(device, "TriggerMode");
  if (!control || !takes_number(*control)) return false;
  const auto value = device.control(*control);
  return value && *value != 0;
}

}  // namespace orbwatch::hal
