#pragma once

#include <string>

namespace orbwatch::app {

/// The register map for tools, one line per row:
/// table,address,count,type,access,name,scale,unit,min,max,description. Reentrant.
std::string registers_csv();

/// The manual for PLC programmers, in Markdown. Reentrant.
std::string registers_markdown();

}  // namespace orbwatch::app
