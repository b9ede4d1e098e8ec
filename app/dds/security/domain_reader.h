#pragma once

#include <string>
#include <vector>

#include "app/dds/security/governance.h"
#include "app/dds/security/xml_reader.h"

namespace orbwatch::app {

/// Adds what `element` says about the domains of the rule at the path `rule`, if it says something:
/// <domains> with <id>, or <id_range> with <min> and <max>. A number that is none counts for no
/// domain.
void read_domain(const XmlElement& element, const std::string& rule,
                 std::vector<DomainRange>& domains);

}  // namespace orbwatch::app
