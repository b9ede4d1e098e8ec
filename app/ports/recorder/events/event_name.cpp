// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_name.h"

#include <algorithm>

#include "app/model/status/utc_text.h"

namespace orbwatch::app::recorder {

std::string event_name(Utc triggered, TriggerKind trigger) {
  return compact_utc_text(triggered).value_or("") + "-" + std::string(name_of(trigger));
}

bool is_event_name(std::string_view name) {
  const bool has_moment = name.size() > kCompactUtcLength && name[kCompactUtcLength] == '-' &&
                          is_compact_utc_text(name.substr(0, kCompactUtcLength));
  if (!has_moment) return false;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  name.remove_prefix(kCompactUtcLength + 1);
  return std::ranges::any_of(kTriggerKinds, [&](TriggerKind kind) {
    if (!name.starts_with(name_of(kind))) return false;
    const std::string_view number = name.substr(name_of(kind).size());
    return number.empty() || (number.size() > 1 && number.front() == '-' &&
                              std::ranges::all_of(number.substr(1), is_digit));
  });
}

}  // namespace orbwatch::app::recorder
