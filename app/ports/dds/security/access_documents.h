// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/certificates/certificate.h"

/// The two documents of DDS Security, governance and permissions, written and read. All reentrant.
namespace orbwatch::app::dds {

/// DDS domains from `first` to `last`, both included.
struct DomainRange {
  int first = 0;
  int last = 0;
};

bool contains(const std::vector<DomainRange>& domains, int domain);

/// The protection of domains as XML of DDS Security 1.1, 9.4.1.2: participants are authenticated,
/// each topic is under access control, every message is signed, and content, discovery and
/// liveliness are encrypted. `bulk_topics`, names with '*' for any text, carry much data: their
/// submessages are protected from outsiders only, not from other participants.
std::string governance_document(const DomainRange& domains,
                                const std::vector<std::string>& bulk_topics);

/// The domains for which a governance document has rules. Error: not such XML.
Result<std::vector<DomainRange>> governed_domains(const std::string& document);

/// DDS names of topics; '*' stands for any text, '/' included.
struct TopicAccess {
  std::vector<std::string> publish;
  std::vector<std::string> subscribe;
};

/// The rights of one participant.
struct Grant {
  std::string subject;  ///< subject of its certificate
  ValidityPeriod validity;
  std::vector<DomainRange> domains;
  TopicAccess topics;
};

/// A grant as XML of DDS Security 1.1, 9.4.1.3; everything else is denied. Subject and topics must
/// not contain special characters of XML.
std::string permissions_document(const Grant& grant);

/// The grants of a permissions document, with their allow rules only. Errors: not such XML, an
/// invalid date.
Result<std::vector<Grant>> read_permissions(const std::string& document);

/// The grant for the holder of a certificate with this subject, or nullptr. The order of a
/// subject's parts is irrelevant, as in Cyclone DDS.
const Grant* find_grant(const std::vector<Grant>& grants, const std::string& subject);

}  // namespace orbwatch::app::dds
