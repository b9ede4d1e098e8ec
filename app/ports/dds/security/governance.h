#pragma once

#include <string>
#include <vector>

#include "app/ports/dds/security/xml_reader.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// DDS domains from `first` to `last`, both included.
struct DomainRange {
  int first = 0;
  int last = 0;
};

bool contains(const std::vector<DomainRange>& domains, int domain);

/// Adds the domains that `element` gives the rule at the path `rule`: <domains> with <id>, or
/// <id_range> with <min> and <max>. An invalid number stands for no domain.
void read_domain(const XmlElement& element, const std::string& rule,
                 std::vector<DomainRange>& domains);

/// The protection of domains as XML of DDS Security 1.1, 9.4.1.2: participants are authenticated,
/// each topic is under access control, every message is signed, and content, discovery and
/// liveliness are encrypted. `bulk_topics`, names with '*' for any text, carry much data: their
/// submessages are protected from outsiders only, not from other participants.
std::string governance_document(const DomainRange& domains,
                                const std::vector<std::string>& bulk_topics);

/// The domains that a governance document has rules for. Error: no such XML.
Result<std::vector<DomainRange>> governed_domains(const std::string& document);

}  // namespace orbwatch::app
