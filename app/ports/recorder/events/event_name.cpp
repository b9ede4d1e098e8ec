// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_name.h"

#include <algorithm>

#include "app/model/status/utc_text.h"

namespace orbwatch::app::recorder {

std::string event_name(Utc triggered, TriggerKind trigger) {
  std::string text = utc_text(triggered).value_or("");
  std::erase_if(text, [](char c) { return c == '-' || c == ':'; });
  return text.substr(0, text.find('.') + 4) + "Z-" + std::string(name_of(trigger));
}

bool is_event_name(std::string_view name) {
  constexpr std::string_view kForm = "00000000T000000.000Z-";
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (name.size() < kForm.size() ||
      !std::ranges::equal(name.substr(0, kForm.size()), kForm, [&](char given, char form) {
        return form == '0' ? is_digit(given) : given == form;
      })) {
    return false;
  }
  name.remove_prefix(kForm.size());
  return std::ranges::any_of(kTriggerKinds, [&](TriggerKind kind) {
    if (!name.starts_with(name_of(kind))) return false;
    const std::string_view number = name.substr(name_of(kind).size());
    return number.empty() || (number.size() > 1 && number.front() == '-' &&
                              std::ranges::all_of(number.substr(1), is_digit));
  });
}

}  // namespace orbwatch::app::recorder
