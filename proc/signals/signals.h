#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "proc/signals/signal_list.h"

namespace orbwatch::signals {

/// A signal without a value: no hot spot, or a camera that is not radiometric.
inline constexpr double kNotValid = std::numeric_limits<double>::quiet_NaN();
inline bool is_valid(double value) { return !std::isnan(value); }

/// What the process is doing, in the units of signal_list.h; kNotValid where nothing is known.
struct Signals {
#define ORBWATCH_MEMBER(name, unit, scale, minimum, maximum, description) double name = kNotValid;
  ORBWATCH_SIGNALS(ORBWATCH_MEMBER)
#undef ORBWATCH_MEMBER
};

/// The facts about one signal, for translators and manuals.
struct SignalInfo {
  std::string_view name;
  std::string_view unit;
  double scale;
  double minimum;
  double maximum;
  std::string_view description;
  double Signals::*member;
};

inline constexpr std::array kSignals{
#define ORBWATCH_INFO(name, unit, scale, minimum, maximum, description) \
  SignalInfo{#name, unit, scale, minimum, maximum, description, &Signals::name},
    ORBWATCH_SIGNALS(ORBWATCH_INFO)
#undef ORBWATCH_INFO
};

}  // namespace orbwatch::signals
