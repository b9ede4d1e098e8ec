#pragma once

#include <array>
#include <string_view>

#include "app/health/health_list.h"
#include "proc/signals/signals.h"

namespace orbwatch::app {

/// How the appliance is, in the units of health_list.h; signals::kNotValid where it cannot be known
/// on this board.
struct Health {
#define ORBWATCH_MEMBER(name, unit, scale, minimum, maximum, description) \
  double name = signals::kNotValid;
  ORBWATCH_HEALTH(ORBWATCH_MEMBER)
#undef ORBWATCH_MEMBER
};

/// The facts about one figure, for translators and manuals.
struct HealthInfo {
  std::string_view name;
  std::string_view unit;
  double scale;
  double minimum;
  double maximum;
  std::string_view description;
  double Health::*member;
};

inline constexpr std::array kHealthFigures{
#define ORBWATCH_INFO(name, unit, scale, minimum, maximum, description) \
  HealthInfo{#name, unit, scale, minimum, maximum, description, &Health::name},
    ORBWATCH_HEALTH(ORBWATCH_INFO)
#undef ORBWATCH_INFO
};

}  // namespace orbwatch::app
