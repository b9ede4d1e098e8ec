#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>

#include "app/model/field.h"
#include "app/ports/modbus/map/register_map.h"

/// How values become the contents of registers, and what that says about their rows. All reentrant.
namespace orbwatch::app::modbus {

/// A measured number without a value.
inline constexpr std::uint32_t kNotValidCode = 0x80000000;

/// An age beyond 2^31 - 1 ms, or of what never happened.
inline constexpr std::uint32_t kMaxAge = 0x7fffffff;

/// The code of an entry that is not configured: not 0, which would mean that all is well.
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

/// round(value / scale) as a signed number, or kNotValidCode. Clamped to the range, which rounding
/// noise of the computation must not leave.
std::uint32_t encoded(double value, const Quantity& quantity);

/// The age of `moment` in ms, which stays at kMaxAge: a PLC that reads it as a DINT must never get
/// a negative age.
std::uint32_t age_code(hal::TimePoint moment, hal::TimePoint now);

/// The content of a row: measured numbers and ages as above, codes by their numbers, counts cut to
/// 32 bits (they continue at 0).
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

/// "0 starting; 1 running".
std::string listed(const std::vector<CodeText>& codes);

/// All numbers of an enumeration, in its row's description.
template <Enumeration Enum>
std::string listed_codes() {
  return listed(code_texts<Enum>());
}

/// From 0 to the last number of an enumeration.
template <Enumeration Enum>
Quantity code_range() {
  return {"", 1, 0, static_cast<double>(code_texts<Enum>().back().number)};
}

}  // namespace orbwatch::app::modbus
