#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

#include "proc/signals/signal_list.h"

namespace orbwatch::signals {

/// Regions of interest that can be measured at once.
inline constexpr std::size_t kMaxRegions = 4;

/// A signal without a value: no hot spot, or a camera that is not radiometric.
inline constexpr double kNotValid = std::numeric_limits<double>::quiet_NaN();
inline bool is_valid(double value) { return !std::isnan(value); }

/// What the process is doing in one region, in the units of signal_list.h; kNotValid where nothing
/// is known.
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

/// A signal and those that tell how it went over the last second.
struct MainSignal {
  double Signals::*value;
  double Signals::*mean;
  double Signals::*deviation;
  double Signals::*trend;
};

inline constexpr std::array kMainSignals{
#define ORBWATCH_MAIN(X, name, unit, scale, minimum, maximum)                   \
  MainSignal{&Signals::name, &Signals::name##_mean, &Signals::name##_deviation, \
             &Signals::name##_trend},
    ORBWATCH_MAIN_SIGNALS(ORBWATCH_MAIN, )
#undef ORBWATCH_MAIN
};

// A Modbus request reads 125 registers: a header of about 20, and two for each signal.
static_assert(kSignals.size() <= 52);

}  // namespace orbwatch::signals
