// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/configuration/configuration_body.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace orbwatch::app::web {
namespace {

constexpr const char* kConfigurationForm =
    R"(the body must be {"files": {"NAME": "TEXT", ...}, "based_on": {"NAME": "CHECKSUM", ...}, )"
    R"("seconds": 60})";

bool is_known(const std::string& member) {
  return member == kFilesMember.name || member == kBasedOnMember.name ||
         member == kSecondsMember.name;
}

/// Reads based_on; if absent, versions are not compared.
Result<ConfigurationFiles::Basis> basis_of(const nlohmann::json& sent) {
  ConfigurationFiles::Basis basis;
  const auto member = sent.find(kBasedOnMember.name);
  if (member == sent.end()) return basis;
  if (!member->is_object())
    return fail(std::string("based_on is not an object: ") + kConfigurationForm);
  for (const auto& [name, checksum] : member->items()) {
    if (!checksum.is_string()) {
      return fail("based_on: " + name + " is not a string: " + kConfigurationForm);
    }
    basis[name] = checksum.get<std::string>();
  }
  return basis;
}

}  // namespace

Result<int> seconds_of(const nlohmann::json& sent) {
  const auto seconds = sent.find(kSecondsMember.name);
  if (seconds == sent.end()) return kUsualTrial;
  const bool is_right =
      seconds->is_number_integer() && *seconds >= kShortestTrial && *seconds <= kLongestTrial;
  if (is_right) return seconds->get<int>();
  // The value is not quoted, because it may be long, and nested so deeply that writing it would
  // crash the process.
  return fail("seconds must be a whole number from " + std::to_string(kShortestTrial) + " to " +
              std::to_string(kLongestTrial));
}

Result<ConfigurationBody> parse_configuration(std::string_view body) {
  const auto sent = nlohmann::json::parse(body, nullptr, false);
  const std::string files_name(kFilesMember.name);
  if (!sent.is_object() || !sent.contains(files_name) || !sent[files_name].is_object()) {
    return fail(std::string("files must be an object: ") + kConfigurationForm);
  }
  ConfigurationBody parsed;
  for (const auto& [name, text] : sent[files_name].items()) {
    if (!text.is_string()) return fail(name + " must be a string: " + kConfigurationForm);
    parsed.edit.texts[name] = text.get<std::string>();
  }
  auto basis = basis_of(sent);
  if (!basis) return tl::unexpected(basis.error());
  parsed.edit.based_on = std::move(*basis);
  const auto seconds = seconds_of(sent);
  if (!seconds) return tl::unexpected(seconds.error());
  parsed.seconds = *seconds;
  for (const auto& [member, value] : sent.items()) {
    if (!is_known(member)) return fail("unknown member " + member + ": " + kConfigurationForm);
  }
  return parsed;
}

}  // namespace orbwatch::app::web
