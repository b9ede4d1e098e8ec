// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "app/files/toml/finding.h"

namespace orbwatch::app::files {

/// True if a name can be part of topics and file names: letters, digits and single _, a letter
/// first, at most 64.
bool is_plain_name(const std::string& name);

/// Refuses names that are not plain or not unique. The items have a name and a line.
template <class Named>
void check_names(const std::vector<Named>& list, const std::string& key, Finding& finding) {
  std::set<std::string> seen;
  for (const Named& item : list) {
    if (!is_plain_name(item.name)) {
      finding.refuse(item.line, key + ".name",
                     "\"" + item.name +
                         "\" is not allowed; it must be letters, digits and single _, "
                         "a letter first");
    }
    if (!seen.insert(item.name).second) {
      finding.refuse(item.line, key + ".name", "\"" + item.name + "\" is there twice");
    }
  }
}

}  // namespace orbwatch::app::files
