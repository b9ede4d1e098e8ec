// SPDX-License-Identifier: Apache-2.0
#include "app/cli/archive/archive.h"

#include <algorithm>
#include <cctype>

namespace orbwatch::app::cli {
namespace {

constexpr std::size_t kLongestName = 255;

bool is_control(char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; }

/// The name as a message may show it.
std::string shown(std::string_view name) {
  std::string text(name.substr(0, kLongestName));
  std::ranges::replace_if(text, is_control, '?');
  return text;
}

}  // namespace

Result<> check_archived_name(std::string_view name) {
  bool is_right =
      !name.empty() && name.size() <= kLongestName && std::ranges::none_of(name, is_control);
  for (std::size_t begin = 0; is_right && begin <= name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    const std::string_view part = name.substr(begin, end - begin);
    is_right = !part.empty() && part != "." && part != "..";
    begin = end + 1;
  }
  if (is_right) return {};
  return fail("the name \"" + shown(name) + "\" is not a relative path without \"..\"");
}

}  // namespace orbwatch::app::cli
