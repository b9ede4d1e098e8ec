// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/map/encoding.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::app::modbus {

std::uint32_t encoded(double value, const Quantity& quantity) {
  if (!std::isfinite(value)) return kNotValidCode;
  const double code =
      std::round(std::clamp(value, quantity.minimum, quantity.maximum) / quantity.scale);
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(code));
}

std::uint32_t age_code(hal::TimePoint moment, hal::TimePoint now) {
  using std::chrono::milliseconds;
  if (moment == hal::TimePoint{}) return kMaxAge;
  const auto age = std::chrono::duration_cast<milliseconds>(now - moment).count();
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(age, 0, kMaxAge));
}

std::uint16_t part_word(std::string_view text, std::size_t n) {
  const auto byte = [text](std::size_t at) {
    return static_cast<unsigned>(at < text.size() ? static_cast<unsigned char>(text[at]) : 0);
  };
  return static_cast<std::uint16_t>(byte(2 * n) << 8 | byte(2 * n + 1));
}

std::string part_words_text(std::string_view description, int n) {
  return std::string(description) + ", bytes " + std::to_string(2 * n) + " and " +
         std::to_string(2 * n + 1) + " of UTF-8, the first one high; 0: it is shorter";
}

std::string listed(const std::vector<CodeText>& codes) {
  std::string text;
  for (const CodeText& code : codes) {
    text += (text.empty() ? "" : "; ") + std::to_string(code.number) + " " + std::string(code.text);
  }
  return text;
}

}  // namespace orbwatch::app::modbus
