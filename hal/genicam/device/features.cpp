// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/device/features.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <sstream>
#include <utility>

namespace orbwatch::hal {
namespace {

constexpr std::string_view kTriggerMode = "TriggerMode";

tl::unexpected<Error> refused(std::string_view name, const std::string& reason) {
  return fail("control " + std::string(name) + " " + reason);
}

Result<> done(std::string_view name, const AravisError& error) {
  if (!error) return {};
  return refused(name, "cannot be set: " + error.message());
}

std::string number_text(double number) {
  std::ostringstream text;
  text.precision(10);
  text << number;
  return text.str();
}

/// Limits that a camera states for a number now.
struct Limits {
  double least = 0;
  double most = 0;
  double step = 0;  ///< increment from `least`; 0: any value
};

Result<> check(std::string_view name, double value, const Limits& limits) {
  const bool is_inside = value >= limits.least && value <= limits.most;
  const bool is_step = limits.step <= 1 || std::remainder(value - limits.least, limits.step) == 0;
  if (is_inside && is_step) return {};
  std::string text = "cannot be " + number_text(value) + "; it takes " + number_text(limits.least) +
                     " to " + number_text(limits.most);
  if (limits.step > 1) text += " in steps of " + number_text(limits.step);
  return refused(name, text);
}

/// Feature of older cameras that the library finds by one of several names.
struct OlderName {
  std::string_view name;
  gboolean (*is_available)(ArvCamera*, GError**);
  void (*bounds)(ArvCamera*, double*, double*, GError**);
  double (*get)(ArvCamera*, GError**);
  void (*set)(ArvCamera*, double, GError**);
};

constexpr std::array kOlderNames{
    OlderName{"ExposureTime", arv_camera_is_exposure_time_available,
              arv_camera_get_exposure_time_bounds, arv_camera_get_exposure_time,
              arv_camera_set_exposure_time},
    OlderName{"Gain", arv_camera_is_gain_available, arv_camera_get_gain_bounds, arv_camera_get_gain,
              arv_camera_set_gain},
};

const OlderName* older_name(std::string_view name) {
  const auto* const found = std::ranges::find(kOlderNames, name, &OlderName::name);
  return found == kOlderNames.end() ? nullptr : found;
}

Result<> set_older(ArvCamera* camera, const OlderName& feature, double value) {
  AravisError error;
  Limits limits;
  feature.bounds(camera, &limits.least, &limits.most, error.out());
  if (auto read = done(feature.name, error); !read) return read;
  if (auto good = check(feature.name, value, limits); !good) return good;
  feature.set(camera, value, error.out());
  return done(feature.name, error);
}

struct Entry {
  std::string name;
  std::int64_t number = 0;
};

/// Menu entries that the camera offers now.
std::vector<Entry> entries_of(ArvGcEnumeration* menu) {
  guint count = 0;
  const OwnedMemory<const char*> names(
      arv_gc_enumeration_dup_available_string_values(menu, &count, nullptr));
  guint number_count = 0;
  const OwnedMemory<gint64> numbers(
      arv_gc_enumeration_dup_available_int_values(menu, &number_count, nullptr));
  std::vector<Entry> entries;
  for (guint i = 0; i < std::min(count, number_count); ++i) {
    entries.push_back({text_of(names.get()[i]), numbers.get()[i]});
  }
  return entries;
}

/// Texts that `orbwatch list` shows: "1 = Line1".
std::vector<std::string> entry_texts(const std::vector<Entry>& entries) {
  std::vector<std::string> texts;
  texts.reserve(entries.size());
  for (const Entry& entry : entries) {
    texts.push_back(std::to_string(entry.number) + " = " + entry.name);
  }
  return texts;
}

/// Cameras assign numbers to Off, Once and Continuous arbitrarily.
std::vector<Entry> as_switch(std::vector<Entry> entries) {
  std::vector<Entry> numbered;
  for (Entry& entry : entries) {
    if (entry.name == "Off")
      numbered.push_back({std::move(entry.name), 0});
    else if (entry.name == "Continuous")
      numbered.push_back({std::move(entry.name), 1});
  }
  std::ranges::sort(numbered, {}, &Entry::number);
  return numbered;
}

/// Entries by the numbers that set_feature() accepts.
std::vector<Entry> numbered_entries(ArvGcEnumeration* menu, std::string_view name) {
  auto entries = entries_of(menu);
  return name.ends_with("Auto") ? as_switch(std::move(entries)) : entries;
}

Result<> set_menu(ArvGcEnumeration* menu, std::string_view name, double value) {
  const auto entries = numbered_entries(menu, name);
  const auto entry = std::ranges::find_if(
      entries, [value](const Entry& e) { return static_cast<double>(e.number) == value; });
  if (entry == entries.end()) {
    std::string offers;
    for (const std::string& text : entry_texts(entries)) {
      offers += (offers.empty() ? "" : ", ") + text;
    }
    return refused(name, "cannot be " + number_text(value) + "; it takes " + offers);
  }
  AravisError error;
  arv_gc_enumeration_set_string_value(menu, entry->name.c_str(), error.out());
  return done(name, error);
}

Limits limits_of(ArvGcFloat* number) {
  return {arv_gc_float_get_min(number, nullptr), arv_gc_float_get_max(number, nullptr), 0};
}

Limits limits_of(ArvGcInteger* number) {
  return {static_cast<double>(arv_gc_integer_get_min(number, nullptr)),
          static_cast<double>(arv_gc_integer_get_max(number, nullptr)),
          static_cast<double>(arv_gc_integer_get_inc(number, nullptr))};
}

Result<> set_trigger_mode(ArvCamera* camera, double value, const std::string& source) {
  AravisError error;
  if (value == 0) {
    arv_camera_clear_triggers(camera, error.out());
  } else if (value == 1) {
    arv_camera_set_trigger(camera, source.c_str(), error.out());
  } else {
    return refused(kTriggerMode, "takes 0 (off) and 1 (on)");
  }
  return done(kTriggerMode, error);
}

/// Collects the names of all features below a category, depth first. Categories may name each
/// other, so a name is listed once.
void collect(ArvDevice* device, const char* category, std::vector<std::string>& names) {
  ArvGcNode* const node = arv_device_get_feature(device, category);
  if (node == nullptr) return;
  if (!ARV_IS_GC_CATEGORY(node)) {
    names.emplace_back(category);
    return;
  }
  const std::string self = std::string("/") + category;  // not the name of a feature
  if (std::ranges::find(names, self) != names.end()) return;
  names.push_back(self);
  for (const GSList* entry = arv_gc_category_get_features(ARV_GC_CATEGORY(node)); entry != nullptr;
       entry = entry->next) {
    collect(device, static_cast<const char*>(entry->data), names);
  }
}

std::vector<std::string> feature_names(ArvDevice* device) {
  std::vector<std::string> names;
  collect(device, "Root", names);
  std::erase_if(names, [](const std::string& name) { return name.starts_with('/'); });
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

bool is_read_only(ArvGcNode* node) {
  return arv_gc_feature_node_get_actual_access_mode(ARV_GC_FEATURE_NODE(node)) ==
         ARV_GC_ACCESS_MODE_RO;
}

void put_limits(const Limits& limits, double value, CameraControl& control) {
  control.minimum = limits.least;
  control.maximum = limits.most;
  control.step = limits.step;
  control.default_value = value;
}

/// Describes a feature with a number; nullopt for another one, or one that is not available now.
std::optional<CameraControl> describe(ArvDevice* device, const std::string& name) {
  ArvGcNode* const node = arv_device_get_feature(device, name.c_str());
  if (!ARV_IS_GC_FEATURE_NODE(node)) return std::nullopt;
  if (!arv_device_is_feature_available(device, name.c_str(), nullptr)) return std::nullopt;
  CameraControl control;
  control.name = name;
  if (is_read_only(node)) control.state = "read only";
  if (ARV_IS_GC_ENUMERATION(node)) {
    ArvGcEnumeration* const menu = ARV_GC_ENUMERATION(node);
    const auto entries = numbered_entries(menu, name);
    const std::string now = text_of(arv_gc_enumeration_get_string_value(menu, nullptr));
    control.values = entry_texts(entries);
    for (const Entry& entry : entries) {
      const auto number = static_cast<double>(entry.number);
      control.minimum = std::min(control.minimum, number);
      control.maximum = std::max(control.maximum, number);
      if (entry.name == now) control.default_value = number;
    }
  } else if (ARV_IS_GC_COMMAND(node)) {
    put_limits({0, 0, 1}, 0, control);
  } else if (ARV_IS_GC_BOOLEAN(node)) {
    put_limits({0, 1, 1}, arv_gc_boolean_get_value(ARV_GC_BOOLEAN(node), nullptr), control);
  } else if (ARV_IS_GC_FLOAT(node)) {
    put_limits(limits_of(ARV_GC_FLOAT(node)), arv_gc_float_get_value(ARV_GC_FLOAT(node), nullptr),
               control);
  } else if (ARV_IS_GC_INTEGER(node)) {
    put_limits(limits_of(ARV_GC_INTEGER(node)),
               static_cast<double>(arv_gc_integer_get_value(ARV_GC_INTEGER(node), nullptr)),
               control);
  } else {
    return std::nullopt;
  }
  return control;
}

std::string names_of(ArvDevice* device) {
  std::string text;
  for (const std::string& name : feature_names(device)) {
    if (describe(device, name)) text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "none" : text;
}

Result<> set_node(ArvGcNode* node, std::string_view name, double value) {
  AravisError error;
  if (ARV_IS_GC_ENUMERATION(node)) return set_menu(ARV_GC_ENUMERATION(node), name, value);
  if (ARV_IS_GC_COMMAND(node)) {
    arv_gc_command_execute(ARV_GC_COMMAND(node), error.out());
  } else if (ARV_IS_GC_BOOLEAN(node)) {
    if (auto good = check(name, std::round(value), {0, 1, 1}); !good) return good;
    arv_gc_boolean_set_value(ARV_GC_BOOLEAN(node), std::round(value) != 0, error.out());
  } else if (ARV_IS_GC_FLOAT(node)) {
    if (auto good = check(name, value, limits_of(ARV_GC_FLOAT(node))); !good) return good;
    arv_gc_float_set_value(ARV_GC_FLOAT(node), value, error.out());
  } else if (ARV_IS_GC_INTEGER(node)) {
    const double number = std::round(value);
    if (auto good = check(name, number, limits_of(ARV_GC_INTEGER(node))); !good) return good;
    arv_gc_integer_set_value(ARV_GC_INTEGER(node), static_cast<gint64>(number), error.out());
  } else {
    return refused(name, "does not take a number");
  }
  return done(name, error);
}

}  // namespace

Result<> set_feature(ArvCamera* camera, const std::string& name, double value,
                     const std::string& trigger_source) {
  ArvDevice* const device = arv_camera_get_device(camera);
  ArvGcNode* const node = arv_device_get_feature(device, name.c_str());
  if (!ARV_IS_GC_FEATURE_NODE(node) || ARV_IS_GC_CATEGORY(node)) {
    const OlderName* const older = older_name(name);
    if (older != nullptr && older->is_available(camera, nullptr)) {
      return set_older(camera, *older, value);
    }
    return fail("no control \"" + name + "\"; there are: " + names_of(device));
  }
  if (!arv_device_is_feature_available(device, name.c_str(), nullptr)) {
    return refused(name, "cannot be set now: the camera does not offer it as it is set");
  }
  if (is_read_only(node)) return refused(name, "is read only");
  if (name == kTriggerMode) return set_trigger_mode(camera, value, trigger_source);
  return set_node(node, name, value);
}

std::vector<CameraControl> list_features(ArvCamera* camera) {
  ArvDevice* const device = arv_camera_get_device(camera);
  std::vector<CameraControl> controls;
  for (const std::string& name : feature_names(device)) {
    if (auto control = describe(device, name)) controls.push_back(std::move(*control));
  }
  return controls;
}

std::chrono::microseconds exposure_time(ArvCamera* camera) {
  if (!arv_camera_is_exposure_time_available(camera, nullptr)) return {};
  if (arv_camera_is_exposure_auto_available(camera, nullptr) &&
      arv_camera_get_exposure_time_auto(camera, nullptr) != ARV_AUTO_OFF) {
    return {};
  }
  AravisError error;
  const double exposure = arv_camera_get_exposure_time(camera, error.out());
  constexpr double kLongest = 1e9;  // us
  if (error || !(exposure > 0 && exposure < kLongest)) return {};
  return std::chrono::microseconds(std::llround(exposure));
}

bool waits_for_trigger(ArvCamera* camera) {
  ArvDevice* const device = arv_camera_get_device(camera);
  if (!arv_device_is_feature_available(device, "TriggerMode", nullptr)) return false;
  return text_of(arv_device_get_string_feature_value(device, "TriggerMode", nullptr)) == "On";
}

}  // namespace orbwatch::hal
