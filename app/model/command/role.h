// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "proc/settings/settings.h"

namespace orbwatch::app {

/// Roles in ascending order of rights. The names are in the users file and on the page.
enum class Role : std::uint8_t {
  Nobody,         ///< not logged in
  Viewer,         ///< reads pictures, figures and the description
  Operator,       ///< runs the process: starts and stops, recipes, alarms, views
  Integrator,     ///< sets the appliance up: alignment, outputs, restart
  Administrator,  ///< manages users
};

inline constexpr std::array kRoles{
    Word{"viewer", Role::Viewer},
    Word{"operator", Role::Operator},
    Word{"integrator", Role::Integrator},
    Word{"administrator", Role::Administrator},
};

}  // namespace orbwatch::app
