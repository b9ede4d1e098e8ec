// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/security/access_documents.h"

#include <dds/ddsrt/xmlparser.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <limits>
#include <memory>
#include <optional>
#include <set>

#include "hal/calendar_time.h"

namespace orbwatch::app::dds {
namespace {

/// An element of an XML document and its own text.
struct XmlElement {
  std::string path;  ///< names from the root, separated by '/': "dds/permissions/grant"
  std::string text;
};

/// Result of the parser's callbacks. They refer to an element by its index in `elements` plus one;
/// 0 is the parent of the root.
struct Reading {
  std::vector<XmlElement> elements;
  std::string error;
};

int on_open(void* argument, std::uintptr_t parent, std::uintptr_t* element, const char* name, int) {
  auto& elements = static_cast<Reading*>(argument)->elements;
  const std::string above = parent == 0 ? "" : elements[parent - 1].path + "/";
  elements.push_back({above + name, {}});
  *element = elements.size();
  return 1;
}

int on_attribute(void*, std::uintptr_t, const char*, const char*, int) { return 1; }

int on_text(void* argument, std::uintptr_t element, const char* text, int) {
  if (element > 0) static_cast<Reading*>(argument)->elements[element - 1].text += text;
  return 1;
}

int on_close(void*, std::uintptr_t, int) { return 1; }

void on_error(void* argument, const char* message, int line) {
  auto& error = static_cast<Reading*>(argument)->error;
  if (error.empty()) error = std::string(message) + " in line " + std::to_string(line);
}

/// Reads the elements of a document in opening order, without attributes, by the parser that
/// Cyclone DDS uses for governance and permissions. Error: names reason and line.
Result<std::vector<XmlElement>> read_xml(const std::string& document) {
  constexpr ddsrt_xmlp_callbacks kCallbacks{on_open, on_attribute, on_text, on_close, on_error};
  Reading reading;
  const std::unique_ptr<ddsrt_xmlp_state, void (*)(ddsrt_xmlp_state*)> parser(
      ddsrt_xmlp_new_string(document.c_str(), &reading, &kCallbacks), ddsrt_xmlp_free);
  if (ddsrt_xmlp_parse(parser.get()) < 0 || !reading.error.empty()) {
    return fail("is not XML: " +
                (reading.error.empty() ? "the document is cut off" : reading.error));
  }
  if (reading.elements.empty()) return fail("is not XML: it has no element");
  return std::move(reading.elements);
}

constexpr int kNoDomain = -1;

int number(const std::string& text) {
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? value : kNoDomain;
}

/// Adds the domains that `element` assigns to the rule at the path `rule`: <domains> with <id>, or
/// <id_range> with <min> and <max>. An invalid number matches no domain.
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

/// Rules of topics; the first one that matches a topic applies.
std::string topic_rules(const std::vector<std::string>& bulk_topics) {
  std::string rules;
  for (const std::string& topics : bulk_topics) rules += topic_rule(topics, "NONE");
  return rules + topic_rule("*", "SIGN");
}

const std::string kGrant = "dds/permissions/grant";
const std::string kValidity = kGrant + "/validity/";
const std::string kAllow = kGrant + "/allow_rule";

/// Format of XML Schema's dateTime.
constexpr const char* kDateFormat = "%Y-%m-%dT%H:%M:%S";

/// Parses XML Schema's dateTime to the second; without a zone it is UTC.
std::optional<std::chrono::sys_seconds> read_date(const std::string& text) {
  std::tm calendar{};
  const char* rest = ::strptime(text.c_str(), kDateFormat, &calendar);
  if (!rest) return std::nullopt;
  // Skips a fraction.
  if (*rest == '.') rest += 1 + std::strspn(rest + 1, "0123456789");
  if (*rest == 'Z') ++rest;
  std::chrono::minutes zone{0};
  if (*rest == '+' || *rest == '-') {
    std::tm offset{};
    const char* const end = ::strptime(rest + 1, "%H:%M", &offset);
    if (!end) return std::nullopt;
    zone = std::chrono::minutes(60 * offset.tm_hour + offset.tm_min) * (*rest == '+' ? 1 : -1);
    rest = end;
  }
  if (*rest != '\0') return std::nullopt;
  return hal::moment_of(calendar) - zone;
}

std::string criteria(const std::string& name, const std::vector<std::string>& topics) {
  if (topics.empty()) return {};
  std::string text = "        <" + name + ">\n          <topics>\n";
  for (const std::string& topic : topics) text += "            <topic>" + topic + "</topic>\n";
  return text + "          </topics>\n        </" + name + ">\n";
}

std::string domain_ids(const std::vector<DomainRange>& domains) {
  std::string text;
  for (const DomainRange& range : domains) {
    text += "          <id_range>\n            <min>" + std::to_string(range.first) +
            "</min>\n            <max>" + std::to_string(range.last) +
            "</max>\n          </id_range>\n";
  }
  return text;
}

/// Splits "CN=a,O=b" into its parts; RFC 2253 and OpenSSL's older form differ in order and
/// separator.
std::set<std::string> parts_of(const std::string& subject) {
  std::set<std::string> parts;
  for (std::size_t from = 0; from < subject.size();) {
    const std::size_t to = std::min(subject.find_first_of(",/|", from), subject.size());
    const std::string part = subject.substr(from, to - from);
    const std::size_t first = part.find_first_not_of(' ');
    if (first != std::string::npos) {
      parts.insert(part.substr(first, part.find_last_not_of(' ') - first + 1));
    }
    from = to + 1;
  }
  return parts;
}

}  // namespace

bool contains(const std::vector<DomainRange>& domains, int domain) {
  return std::ranges::any_of(domains, [domain](const DomainRange& range) {
    return range.first <= domain && domain <= range.last;
  });
}

// Content is encrypted once per sample, whatever the number of readers. Submessages are signed, so
// that acknowledgements, gaps and time stamps cannot be forged. The message's signature uses a key
// that all participants share, the submessage's signature a key of the topic.
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

// Dates are written without a zone, that is in UTC, which all vendors can read.
std::string permissions_document(const Grant& grant) {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
     xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">
  <permissions>
    <grant name=")" +
         grant.subject + R"(">
      <subject_name>)" +
         grant.subject + R"(</subject_name>
      <validity>
        <not_before>)" +
         date_text(grant.validity.from, kDateFormat) + R"(</not_before>
        <not_after>)" +
         date_text(grant.validity.until, kDateFormat) + R"(</not_after>
      </validity>
      <allow_rule>
        <domains>
)" + domain_ids(grant.domains) +
         "        </domains>\n" + criteria("publish", grant.topics.publish) +
         criteria("subscribe", grant.topics.subscribe) + R"(      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
)";
}

Result<std::vector<Grant>> read_permissions(const std::string& document) {
  const auto elements = read_xml(document);
  if (!elements) return tl::unexpected(elements.error());
  std::vector<Grant> grants;
  for (const auto& [path, text] : *elements) {
    if (path == kGrant) grants.emplace_back();
    if (!path.starts_with(kGrant + "/")) continue;
    Grant& grant = grants.back();
    if (path == kGrant + "/subject_name") grant.subject = text;
    if (path.starts_with(kValidity)) {
      const auto date = read_date(text);
      if (!date) {
        return fail("has \"" + text + "\" instead of a date such as 2026-01-31T00:00:00");
      }
      (path == kValidity + "not_before" ? grant.validity.from : grant.validity.until) = *date;
    }
    read_domain({path, text}, kAllow, grant.domains);
    if (path == kAllow + "/publish/topics/topic") grant.topics.publish.push_back(text);
    if (path == kAllow + "/subscribe/topics/topic") grant.topics.subscribe.push_back(text);
  }
  return grants;
}

const Grant* find_grant(const std::vector<Grant>& grants, const std::string& subject) {
  const auto parts = parts_of(subject);
  const auto found = std::ranges::find_if(grants, [&parts](const Grant& grant) {
    return std::ranges::includes(parts_of(grant.subject), parts);
  });
  return found == grants.end() ? nullptr : &*found;
}

}  // namespace orbwatch::app::dds
