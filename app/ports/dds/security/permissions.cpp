#include "app/ports/dds/security/permissions.h"

#include <algorithm>
#include <cstring>
#include <ctime>
#include <optional>
#include <set>

namespace orbwatch::app {
namespace {

const std::string kGrant = "dds/permissions/grant";
const std::string kValidity = kGrant + "/validity/";
const std::string kAllow = kGrant + "/allow_rule";

/// UTC as XML Schema's dateTime, without a zone: that is what all vendors read.
std::string date_text(std::chrono::sys_seconds time) {
  const std::time_t seconds = time.time_since_epoch().count();
  std::tm calendar{};
  gmtime_r(&seconds, &calendar);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &calendar)};
}

/// XML Schema's dateTime to the second; without a zone it is UTC.
std::optional<std::chrono::sys_seconds> read_date(const std::string& text) {
  std::tm calendar{};
  const char* rest = ::strptime(text.c_str(), "%Y-%m-%dT%H:%M:%S", &calendar);
  if (!rest) return std::nullopt;
  // A fraction.
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
  return std::chrono::sys_seconds(std::chrono::seconds(timegm(&calendar))) - zone;
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

/// "CN=a,O=b" as its parts; RFC 2253 and OpenSSL's older form differ in order and separator.
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
         date_text(grant.validity.from) + R"(</not_before>
        <not_after>)" +
         date_text(grant.validity.until) + R"(</not_after>
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
        return fail("says \"" + text + "\" where a date must stand, like 2026-01-31T00:00:00");
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

}  // namespace orbwatch::app
