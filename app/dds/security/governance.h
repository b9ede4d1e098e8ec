#pragma once

#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// DDS domains from `first` to `last`, both included.
struct DomainRange {
  int first = 0;
  int last = 0;
};

bool contains(const std::vector<DomainRange>& domains, int domain);

/// How domains are protected, as XML of DDS Security 1.1, 9.4.1.2: nobody joins unauthenticated,
/// each topic is read and written by permission only, everything that is sent is authenticated, and
/// content, discovery and liveliness are encrypted. `bulk_topics`, names with '*' for any text,
/// carry so much that what surrounds their content is protected from outsiders only, not from other
/// participants.
std::string governance_document(const DomainRange& domains,
                                const std::vector<std::string>& bulk_topics);

/// The domains that a governance document has rules for. Error: no such XML.
Result<std::vector<DomainRange>> governed_domains(const std::string& document);

}  // namespace orbwatch::app
