#include "app/modbus/register_values.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::app::modbus {

std::uint32_t saturated(double value, double scale) {
  const double code = std::round(value / scale);
  return code > 0 ? static_cast<std::uint32_t>(std::min(code, 65535.0)) : 0;
}

std::uint32_t scaled(double value, const Quantity& quantity) {
  if (!std::isfinite(value)) return kNotValidCode;
  const double code =
      std::round(std::clamp(value, quantity.minimum, quantity.maximum) / quantity.scale);
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(code));
}

std::uint32_t age_code(std::chrono::milliseconds age) {
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(age.count(), 0, 0x7fffffff));
}

}  // namespace orbwatch::app::modbus
