#pragma once

#include "app/model/interface_table.h"
#include "app/ports/modbus/map/process_image.h"
#include "app/ports/modbus/map/register_map.h"

namespace orbwatch::app::modbus {

/// All mapped places with what a PLC reads there at this moment, in their unit; without those that
/// are reserved or repeat another. Reentrant.
InterfaceTable register_table(const RegisterMap& map, const ProcessImage& image);

}  // namespace orbwatch::app::modbus
