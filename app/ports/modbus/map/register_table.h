// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/model/sink/interface_table.h"
#include "app/ports/modbus/map/process_image.h"
#include "app/ports/modbus/map/register_map.h"

namespace orbwatch::app::modbus {

/// All mapped places with their present value, in their unit, without reserved rows and mirrors.
/// Reentrant.
InterfaceTable register_table(const RegisterMap& map, const ProcessImage& image);

}  // namespace orbwatch::app::modbus
