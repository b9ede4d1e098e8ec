// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/topics/topic_names.h"

#include <algorithm>

namespace orbwatch::app::dds {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

Result<> check_topic_part(std::string_view part, std::string_view what) {
  const bool valid = !part.empty() && !is_digit(part.front()) &&
                     std::ranges::all_of(part, [](char c) { return is_letter(c) || is_digit(c); });
  if (valid) return {};
  return fail("DDS: " + std::string(what) + " \"" + std::string(part) +
              "\" is not a ROS 2 name; it must be letters, digits and '_', without a digit first");
}

Result<> check_topic_path(std::string_view path, std::string_view what) {
  const std::size_t slash = path.find('/');
  const auto checked = check_topic_part(path.substr(0, slash), what);
  if (!checked || slash == std::string_view::npos) return checked;
  return check_topic_path(path.substr(slash + 1), what);
}

}  // namespace orbwatch::app::dds
