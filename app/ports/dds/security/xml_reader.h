#pragma once

#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// An element of an XML document and its own text.
struct XmlElement {
  std::string path;  ///< names from the root on, with '/' between: "dds/permissions/grant"
  std::string text;
};

/// The elements of a document in the order in which they open, without attributes, by the parser
/// that Cyclone DDS uses for governance and permissions. Error: names reason and line.
/// Reentrant.
Result<std::vector<XmlElement>> read_xml(const std::string& document);

}  // namespace orbwatch::app
