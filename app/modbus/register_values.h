#pragma once

#include <chrono>
#include <concepts>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "app/modbus/register_map.h"

namespace orbwatch::app::modbus {

/// How figures become the contents of registers. All reentrant.

/// What a signal without a value reads.
inline constexpr std::uint32_t kNotValidCode = 0x80000000;

/// Scale, unit and range of a row; minimum and maximum in the unit.
struct Quantity {
  double scale = 1;  ///< value in the unit = register * scale
  std::string_view unit;
  double minimum = 0;
  double maximum = 0;
};

/// The scale, unit and range of a signal or health figure.
template <class Info>
constexpr Quantity quantity_of(const Info& info) {
  return {info.scale, info.unit, info.minimum, info.maximum};
}

/// A figure that is never negative, in 16 bits: round(value / scale), which stays at 65535 instead
/// of wrapping; 0 when it is not a number.
std::uint32_t saturated(double value, double scale);

/// A signal: round(value / scale) as a signed number, or kNotValidCode. Clamped to the range, which
/// rounding noise of the computation must not leave.
std::uint32_t scaled(double value, const Quantity& quantity);

/// Milliseconds up to 2^31 - 1, no further: a PLC that reads them as a signed double word (DINT)
/// must never see a negative age.
std::uint32_t age_code(std::chrono::milliseconds age);

/// The content of a register of this type: figures scaled, ages as above, counters cut to the
/// register's width (they go on at 0), enumerations by their numbers.
template <class Value>
std::uint32_t encoded(Value value, Type type, const Quantity& quantity) {
  if constexpr (std::floating_point<Value>) {
    return type == Type::I32 ? scaled(value, quantity) : saturated(value, quantity.scale);
  } else if constexpr (std::is_same_v<Value, std::chrono::milliseconds>) {
    return age_code(value);
  } else {
    const auto code = static_cast<std::uint32_t>(value);
    return type == Type::U16 ? code & 0xffff : code;
  }
}

}  // namespace orbwatch::app::modbus
