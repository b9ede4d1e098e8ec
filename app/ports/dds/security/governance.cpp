#include "app/ports/dds/security/governance.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace orbwatch::app {
namespace {

constexpr int kNoDomain = -1;

int number(const std::string& text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? value : kNoDomain;
}

}  // namespace

bool contains(const std::vector<DomainRange>& domains, int domain) {
  return std::ranges::any_of(domains, [domain](const DomainRange& range) {
    return range.first <= domain && domain <= range.last;
  });
}

void read_domain(const XmlElement& element, const std::string& rule,
                 std::vector<DomainRange>& domains) {
  const std::string place = rule + "/domains/";
  if (!element.path.starts_with(place)) return;
  const std::string what = element.path.substr(place.size());
  const int value = number(element.text);
  if (what == "id") domains.push_back({value, value});
  // A range without <max> is open.
  if (what == "id_range") domains.push_back({0, std::numeric_limits<int>::max()});
  if (what == "id_range/min") domains.back().first = value;
  if (what == "id_range/max") domains.back().last = value;
}

namespace {

std::string topic_rule(const std::string& topics, const char* metadata_protection) {
  return R"(        <topic_rule>
          <topic_expression>)" +
         topics + R"(</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>)" +
         metadata_protection + R"(</metadata_protection_kind>
          <data_protection_kind>ENCRYPT</data_protection_kind>
        </topic_rule>
)";
}

/// The first rule that matches a topic applies.
std::string topic_rules(const std::vector<std::string>& bulk_topics) {
  std::string rules;
  for (const std::string& topics : bulk_topics) rules += topic_rule(topics, "NONE");
  return rules + topic_rule("*", "SIGN");
}

}  // namespace

// Content is encrypted once per sample, whatever the number of readers. Submessages are signed, so
// that nobody can forge acknowledgements, gaps and time stamps. The message's signature uses a key
// that all participants share, the submessage's one of the topic.
std::string governance_document(const DomainRange& domains,
                                const std::vector<std::string>& bulk_topics) {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
  <domain_access_rules>
    <domain_rule>
      <domains>
        <id_range>
          <min>)" +
         std::to_string(domains.first) + R"(</min>
          <max>)" +
         std::to_string(domains.last) + R"(</max>
        </id_range>
      </domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
      <rtps_protection_kind>SIGN</rtps_protection_kind>
      <topic_access_rules>
)" + topic_rules(bulk_topics) +
         R"(      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
)";
}

Result<std::vector<DomainRange>> governed_domains(const std::string& document) {
  return read_xml(document).map([](const std::vector<XmlElement>& elements) {
    std::vector<DomainRange> domains;
    for (const XmlElement& element : elements) {
      read_domain(element, "dds/domain_access_rules/domain_rule", domains);
    }
    return domains;
  });
}

}  // namespace orbwatch::app
