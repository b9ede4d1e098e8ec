// SPDX-License-Identifier: Apache-2.0
#include "app/model/machine/part_name.h"

#include <string>

#include "app/model/plain_text.h"

namespace orbwatch::app {

Result<PartName> PartName::make(std::string_view text) {
  if (text.size() > kMost) {
    return fail("part has " + std::to_string(text.size()) + " bytes; it must be at most " +
                std::to_string(kMost) + " bytes of UTF-8");
  }
  if (plain_text(text, kMost) != text) {
    return fail("part is not one line of UTF-8 without control characters");
  }
  PartName name;
  std::ranges::copy(text, name.bytes_.begin());
  return name;
}

}  // namespace orbwatch::app
