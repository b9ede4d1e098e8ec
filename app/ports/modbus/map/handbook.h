// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace orbwatch::app {

/// The register map for tools, one line per row:
/// table,address,count,type,access,name,scale,unit,min,max,description. Reentrant.
std::string registers_csv();

/// The handbook for PLC programmers, in Markdown: handbook.md.in with the map's own addresses and
/// tables. Throws std::out_of_range for an unknown name in the template. Reentrant.
std::string registers_markdown();

namespace modbus {

/// Text of handbook.md.in. @name@ is the address of the row with this name, @name+@ that of its
/// mirror; capitals are numbers of the layout, the rest are tables.
extern const std::string_view kHandbookTemplate;

}  // namespace modbus
}  // namespace orbwatch::app
