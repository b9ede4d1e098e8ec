// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/names.h"

#include <algorithm>

#include "hal/mcap/limits.h"

namespace orbwatch::hal::mcap {

FileResult<> check_name(const std::string& what, std::string_view name) {
  if (name.empty() || name.size() > kMostName) {
    return refuse(what + ": a name of " + std::to_string(name.size()) +
                  " bytes; it must have 1 to " + std::to_string(kMostName));
  }
  const bool is_plain = std::ranges::none_of(name, [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return code < 0x20 || code == 0x7f;
  });
  if (is_plain) return {};
  return refuse(what + ": a name with control characters; it must be plain text");
}

FileResult<> check_attachment_name(const std::string& what, std::string_view name) {
  if (auto checked = check_name(what, name); !checked) return checked;
  for (std::string_view rest = name;;) {
    const std::size_t slash = rest.find('/');
    const std::string_view part = rest.substr(0, slash);
    if (part.empty() || part == "." || part == "..") {
      return refuse(what + ": the name \"" + std::string(name) +
                    "\"; it must be a relative path without \"..\", such as recipes/weld.toml");
    }
    if (slash == std::string_view::npos) return {};
    rest = rest.substr(slash + 1);
  }
}

}  // namespace orbwatch::hal::mcap
