// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/access_body.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace orbwatch::app::web {
namespace {

/// Form of a body: {"user": "...", "role": "..." (optional)}.
std::string form(const std::vector<BodyMember>& allowed) {
  std::string text = "{";
  for (const BodyMember& member : allowed) {
    text += (text.size() == 1 ? "\"" : ", \"") + std::string(member.name) + "\": \"...\"" +
            (member.is_required ? "" : " (optional)");
  }
  return text + "}";
}

}  // namespace

Result<Members> parse_members(const std::vector<BodyMember>& allowed, std::string_view body) {
  const auto sent = nlohmann::json::parse(body.empty() ? "{}" : body, nullptr, false);
  if (!sent.is_object()) return fail("the body is not a JSON object; it must be " + form(allowed));
  Members members;
  for (const BodyMember& member : allowed) {
    const std::string name(member.name);
    const auto found = sent.find(name);
    const bool is_there = found != sent.end();
    if ((!is_there && member.is_required) || (is_there && !found->is_string())) {
      return fail(name + " must be a string; the body must be " + form(allowed));
    }
    members[name] = is_there ? found->get<std::string>() : "";
  }
  const bool is_known = std::ranges::all_of(sent.items(), [&](const auto& item) {
    return std::ranges::find(allowed, item.key(), &BodyMember::name) != allowed.end();
  });
  if (!is_known) return fail("the body has an unknown member; it must be " + form(allowed));
  return members;
}

}  // namespace orbwatch::app::web
