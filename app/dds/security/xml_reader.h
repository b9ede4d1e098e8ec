#pragma once

#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// An element of an XML document and the text that stands directly in it.
struct XmlElement {
  std::string path;  ///< names from the root on, with '/' between: "dds/permissions/grant"
  std::string text;
};

/// The elements of a document as they open, attributes left out, by the parser that Cyclone DDS
/// reads governance and permissions with. Error: what is wrong and in which line. Reentrant.
Result<std::vector<XmlElement>> read_xml(const std::string& document);

}  // namespace orbwatch::app
