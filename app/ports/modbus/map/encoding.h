// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "app/model/status/field.h"
#include "app/ports/modbus/map/register_map.h"

/// Conversion of values to the contents of registers, and the resulting types and ranges of rows.
/// All reentrant.
namespace orbwatch::app::modbus {

/// Content of an age beyond 2^31 - 1 ms, or of an event that never happened.
inline constexpr std::uint32_t kMaxAge = 0x7fffffff;

/// Code of an entry that is not configured; not 0, which would mean no fault.
inline constexpr std::uint16_t kNone = 0xffff;

template <class Value>
constexpr Type type_of() {
  if constexpr (std::floating_point<Value>) {
    return Type::Dint;
  } else if constexpr (std::is_same_v<Value, hal::TimePoint>) {
    return Type::Udint;
  } else {
    static_assert(Enumeration<Value> || std::unsigned_integral<Value>);
    return Enumeration<Value> || sizeof(Value) <= 2 ? Type::Uint : Type::Udint;
  }
}

/// round(value / scale) as a signed number, or kNotValidCode. Clamped to the range, against
/// rounding noise of the computation.
std::uint32_t encoded(double value, const Quantity& quantity);

/// The age of `moment` in ms, at most kMaxAge: a PLC that reads it as a DINT must never get a
/// negative age.
std::uint32_t age_code(hal::TimePoint moment, hal::TimePoint now);

/// The content of a row: measured numbers and ages as above, codes as their numbers, counts modulo
/// 2^32.
template <class Value>
std::uint32_t encoded(const Value& value, const Quantity& quantity, hal::TimePoint now) {
  if constexpr (std::floating_point<Value>) {
    return encoded(value, quantity);
  } else if constexpr (std::is_same_v<Value, hal::TimePoint>) {
    return age_code(value, now);
  } else {
    return static_cast<std::uint32_t>(value);
  }
}

/// Bytes 2n and 2n + 1 of a text, the first one high; 0 beyond its end.
std::uint16_t part_word(std::string_view text, std::size_t n);

/// Description of register n of a part's name.
std::string part_words_text(std::string_view description, int n);

/// List for a description: "0 starting; 1 running".
std::string listed(const std::vector<CodeText>& codes);

/// All numbers of an enumeration, for its row's description.
template <Enumeration Enum>
std::string listed_codes() {
  return listed(code_texts<Enum>());
}

/// Range from 0 to the last number of an enumeration.
template <Enumeration Enum>
Quantity code_range() {
  return {"", 1, 0, static_cast<double>(code_texts<Enum>().back().number)};
}

}  // namespace orbwatch::app::modbus
