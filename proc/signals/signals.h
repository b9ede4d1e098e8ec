// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "proc/signals/signal_list.h"

namespace orbwatch::signals {

/// Most regions of interest that are measured at once.
inline constexpr std::size_t kMaxRegions = 4;

/// The value of a signal that is unknown: no hot spot, or a requirement is missing.
inline constexpr double kNotValid = std::numeric_limits<double>::quiet_NaN();
inline bool is_valid(double value) { return !std::isnan(value); }

/// The signals of one region and one frame set, in the units of signal_list.h.
struct Signals {
#define ORBWATCH_MEMBER(name, ...) double name = kNotValid;
  ORBWATCH_SIGNALS(ORBWATCH_MEMBER)
#undef ORBWATCH_MEMBER
};

/// Requirements that the region or the machine must meet for a signal to ever have a value. Flags.
enum class Requires : std::uint8_t {
  Nothing = 0,
  SpatterThreshold = 1,
  PlumeThreshold = 2,
  WidthSetPoint = 4,
  RadiometricCamera = 8,
  Scene = 16,
};

constexpr Requires operator|(Requires a, Requires b) {
  return static_cast<Requires>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr bool includes(Requires flags, Requires flag) { return (flags | flag) == flags; }

/// One flag and its operator text.
struct Requirement {
  Requires flag;
  std::string_view text;
};

inline constexpr std::array kRequirements{
    Requirement{Requires::SpatterThreshold, "the region's spatter_threshold"},
    Requirement{Requires::PlumeThreshold, "the region's plume_threshold"},
    Requirement{Requires::WidthSetPoint, "the region's width"},
    Requirement{Requires::RadiometricCamera, "a measured camera with kelvin_per_count"},
    Requirement{Requires::Scene, "the rig's scene"},
};

/// The description of one signal.
struct SignalInfo {
  std::string_view name;
  std::string_view title;
  std::string_view unit;
  double scale;
  double minimum;
  double maximum;
  Requires requirements;
  std::string_view description;
  double Signals::*member;
};

inline constexpr auto kSignals = [] {
  using enum Requires;
#define ORBWATCH_INFO(name, title, unit, scale, minimum, maximum, requirements, description) \
  SignalInfo{#name,   title,        unit,        scale,         minimum,                     \
             maximum, requirements, description, &Signals::name},
  return std::array{ORBWATCH_SIGNALS(ORBWATCH_INFO)};
#undef ORBWATCH_INFO
}();

/// The first unmet requirement of a signal; nullopt: it can have a value.
constexpr std::optional<Requirement> first_missing(const SignalInfo& signal, Requires provided) {
  for (const Requirement& requirement : kRequirements) {
    const bool is_required = includes(signal.requirements, requirement.flag);
    if (is_required && !includes(provided, requirement.flag)) return requirement;
  }
  return std::nullopt;
}

/// A signal and its statistics over the last second.
struct MainSignal {
  double Signals::*value;
  double Signals::*mean;
  double Signals::*deviation;
  double Signals::*trend;
};

inline constexpr std::array kMainSignals{
#define ORBWATCH_MAIN(X, name, ...)                                             \
  MainSignal{&Signals::name, &Signals::name##_mean, &Signals::name##_deviation, \
             &Signals::name##_trend},
    ORBWATCH_MAIN_SIGNALS(ORBWATCH_MAIN, )
#undef ORBWATCH_MAIN
};

}  // namespace orbwatch::signals
