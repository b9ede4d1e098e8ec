// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/ports/modbus/map/register_map.h"

namespace orbwatch::app::modbus {

inline const RegisterMap& registers() {
  static const RegisterMap map;
  return map;
}

}  // namespace orbwatch::app::modbus
