// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/controls/libcamera_controls.h"

#include <libcamera/control_ids.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

#include "proc/settings/settings.h"

namespace orbwatch::hal {
namespace {

/// GenICam names (SFNC 2.7) for controls of libcamera.
constexpr std::array kAliases{
    Word<std::string_view>{"Gain", "AnalogueGain"},
    Word<std::string_view>{"ExposureAuto", "AeEnable"},
    Word<std::string_view>{"BalanceWhiteAuto", "AwbEnable"},
};

constexpr std::array<std::string_view, 2> kColourGains{"ColourGains[0]", "ColourGains[1]"};

bool is_colour_gain(std::string_view name) {
  return std::ranges::find(kColourGains, name) != kColourGains.end();
}

std::string_view control_name(std::string_view name) {
  if (is_colour_gain(name)) return name.substr(0, name.find('['));
  const std::string_view* const control = find_word(kAliases, name);
  return control != nullptr ? *control : name;
}

std::string names_of(const libcamera::ControlInfoMap& offered) {
  std::vector<std::string> names;
  for (const auto& [id, info] : offered) names.push_back(id->name());
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

/// Calls `visit(T())` with the number type T of that control type; does nothing for a type that is
/// not a number.
template <class Visit>
auto with_number(libcamera::ControlType type, const Visit& visit)
    -> std::optional<decltype(visit(false))> {
  switch (type) {
    case libcamera::ControlTypeBool:
      return visit(false);
    case libcamera::ControlTypeByte:
      return visit(std::uint8_t{});
    case libcamera::ControlTypeInteger32:
      return visit(std::int32_t{});
    case libcamera::ControlTypeInteger64:
      return visit(std::int64_t{});
    case libcamera::ControlTypeFloat:
      return visit(0.0F);
    default:
      return std::nullopt;
  }
}

/// Converts a value; nullopt for none, arrays and values that are not numbers.
std::optional<double> as_number(const libcamera::ControlValue& value) {
  if (value.isArray()) return std::nullopt;
  return with_number(value.type(), [&value](auto number) {
    return static_cast<double>(value.get<decltype(number)>());
  });
}

struct Limits {
  double least;
  double most;
};

/// Range of a type; nullopt for one that is not a number. A double has the integers up to 2^53.
std::optional<Limits> limits_of(libcamera::ControlType type) {
  return with_number(type, []<class Number>(Number) {
    using Holds = std::numeric_limits<Number>;
    if (Holds::digits == 63) return Limits{-0x1p53, 0x1p53};
    return Limits{static_cast<double>(Holds::lowest()), static_cast<double>(Holds::max())};
  });
}

/// A control's limits; nullopt for non-numeric ones.
std::optional<Limits> limits_of(libcamera::ControlType type, const libcamera::ControlInfo& info) {
  auto limits = limits_of(type);
  if (!limits) return std::nullopt;
  limits->least = std::max(limits->least, as_number(info.min()).value_or(limits->least));
  limits->most = std::min(limits->most, as_number(info.max()).value_or(limits->most));
  return limits;
}

/// Returns `value`, rounded for integer controls.
Result<double> check(std::string_view name, libcamera::ControlType type,
                     const libcamera::ControlInfo& info, double value) {
  const auto limits = limits_of(type, info);
  if (!limits) return fail("control " + std::string(name) + " does not take a number");
  const double number = type == libcamera::ControlTypeFloat ? value : std::round(value);
  if (number >= limits->least && number <= limits->most) return number;
  std::ostringstream message;
  message << "control " << name << " cannot be " << value << "; it takes " << limits->least
          << " to " << limits->most;
  return fail(message.str());
}

void put_colour_gain(std::size_t element, double gain, libcamera::ControlList& list) {
  namespace controls = libcamera::controls;
  std::array<float, 2> gains{1, 1};
  if (const auto known = list.get(controls::ColourGains)) {
    std::copy(known->begin(), known->end(), gains.begin());
  }
  gains[element] = static_cast<float>(gain);
  list.set(controls::ColourGains, libcamera::Span<const float, 2>(gains));
}

/// True for a control with more than one number.
bool is_array(const libcamera::ControlId& id) {
  namespace controls = libcamera::controls;
  const std::array<const libcamera::ControlId*, 3> arrays{
      &controls::ColourGains, &controls::FrameDurationLimits, &controls::ColourCorrectionMatrix};
  return std::find(arrays.begin(), arrays.end(), &id) != arrays.end();
}

/// Rounding of sensors: exposures to lines, gains to codes, which are coarse at high gains.
constexpr double kExposureError = 60;  // us
constexpr double kRelativeError = 0.05;

bool is_near(double asked, double stated, double error) {
  return std::abs(asked - stated) <= std::max(error, kRelativeError * asked);
}

/// True if both lists have the control, with values that are not near each other.
template <class Number>
bool differs(const libcamera::Control<Number>& control, const libcamera::ControlList& asked,
             const libcamera::ControlList& stated, double error) {
  const auto wanted = asked.get(control);
  const auto got = stated.get(control);
  return wanted && got && !is_near(static_cast<double>(*wanted), static_cast<double>(*got), error);
}

bool colours_differ(const libcamera::ControlList& asked, const libcamera::ControlList& stated) {
  const auto wanted = asked.get(libcamera::controls::ColourGains);
  const auto got = stated.get(libcamera::controls::ColourGains);
  return wanted && got &&
         !std::equal(wanted->begin(), wanted->end(), got->begin(), [](float a, float b) {
           return is_near(static_cast<double>(a), static_cast<double>(b), 0);
         });
}

CameraControl describe(std::string_view name, const libcamera::ControlInfo& info,
                       libcamera::ControlType type, const Limits& limits) {
  CameraControl control{.name = std::string(name),
                        .minimum = limits.least,
                        .maximum = limits.most,
                        .step = type == libcamera::ControlTypeFloat ? 0.0 : 1.0,
                        .default_value = as_number(info.def()).value_or(0),
                        .state = {},
                        .values = {}};
  for (const libcamera::ControlValue& value : info.values()) {
    control.values.push_back(value.toString());
  }
  return control;
}

}  // namespace

const libcamera::ControlId* find_control(const libcamera::ControlInfoMap& offered,
                                         std::string_view name) {
  const std::string_view wanted = control_name(name);
  const auto found = std::find_if(offered.begin(), offered.end(), [wanted](const auto& control) {
    return control.first->name() == wanted;
  });
  return found == offered.end() ? nullptr : found->first;
}

Result<> put_control(const libcamera::ControlInfoMap& offered, std::string_view name, double value,
                     libcamera::ControlList& list) {
  const libcamera::ControlId* const id = find_control(offered, name);
  if (id == nullptr) {
    return fail("no control \"" + std::string(name) + "\"; there are: " + names_of(offered));
  }
  if (is_array(*id) && !is_colour_gain(name)) {
    const bool gains = id == &libcamera::controls::ColourGains;
    return fail("control " + id->name() + " takes more than one number; " +
                (gains ? "set ColourGains[0] for red and ColourGains[1] for blue"
                       : "it cannot be set by name"));
  }
  const auto number = check(name, id->type(), offered.at(id), value);
  if (!number) return tl::unexpected(number.error());
  if (is_colour_gain(name)) {
    put_colour_gain(name == kColourGains[0] ? 0 : 1, *number, list);
  } else {
    list.set(id->id(), *with_number(id->type(), [&number]<class Number>(Number) {
               return libcamera::ControlValue(static_cast<Number>(*number));
             }));
  }
  return {};
}

std::vector<CameraControl> list_controls(const libcamera::ControlInfoMap& offered) {
  std::vector<CameraControl> controls;
  for (const auto& [id, info] : offered) {
    const auto limits = limits_of(id->type(), info);
    if (!limits) continue;
    if (id == &libcamera::controls::ColourGains) {
      for (const auto gain : kColourGains) {
        controls.push_back(describe(gain, info, id->type(), *limits));
      }
    } else if (!is_array(*id)) {
      controls.push_back(describe(id->name(), info, id->type(), *limits));
    }
  }
  std::ranges::sort(controls, {}, &CameraControl::name);
  return controls;
}

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

const libcamera::ControlId* ControlSettings::find_other(
    const libcamera::ControlList& metadata) const {
  namespace controls = libcamera::controls;
  const std::lock_guard lock(mutex_);
  if (!all_.get(controls::AeEnable).value_or(false)) {
    if (differs(controls::ExposureTime, all_, metadata, kExposureError)) {
      return &controls::ExposureTime;
    }
    if (differs(controls::AnalogueGain, all_, metadata, 0)) return &controls::AnalogueGain;
  }
  const bool is_white_fixed = !all_.get(controls::AwbEnable).value_or(false);
  return is_white_fixed && colours_differ(all_, metadata) ? &controls::ColourGains : nullptr;
}

void ControlSettings::add_changes(libcamera::ControlList& request) {
  if (!changed_) return;
  const std::lock_guard lock(mutex_);
  for (const auto& [id, value] : changes_) request.set(id, value);
  changes_.clear();
  changed_ = false;
}

}  // namespace orbwatch::hal
