#pragma once

#include <string>

#include "app/modbus/register_map.h"

namespace orbwatch::app::modbus {

/// The chapters of the manual that are written by hand, in Markdown, with the map's own addresses:
/// how to read, take results, give commands. Reentrant.
std::string manual_text(const RegisterMap& map);

}  // namespace orbwatch::app::modbus
