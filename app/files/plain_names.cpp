// SPDX-License-Identifier: Apache-2.0
#include "app/files/plain_names.h"

#include <algorithm>
#include <cctype>

namespace orbwatch::app::files {

bool is_plain_name(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), plain) &&
         std::isalpha(static_cast<unsigned char>(name.front())) && name.back() != '_' &&
         name.find("__") == std::string::npos;
}

}  // namespace orbwatch::app::files
