#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orbwatch::hal {

/// The faults of a running camera. PLCs read the numbers (Modbus) and controllers receive them
/// (DDS): append, never renumber.
enum class Fault : std::uint8_t {
  None = 0,
  Unplugged = 1,
  Stalled = 2,
  ReadError = 3,
  CorruptFrame = 4,
  WrongFormat = 5,
};

/// The one place of the operator's text for each fault. Empty for a number that is none.
constexpr std::string_view operator_text(Fault fault) {
  switch (fault) {
    case Fault::None:
      return "camera delivers";
    case Fault::Unplugged:
      return "camera is not connected";
    case Fault::Stalled:
      return "camera sends no frames";
    case Fault::ReadError:
      return "camera reports a read error";
    case Fault::CorruptFrame:
      return "camera sends damaged frames";
    case Fault::WrongFormat:
      return "camera sends another format than configured";
  }
  return {};
}

/// A change of a camera's state. Fault::None: it delivers again.
struct FaultReport {
  Fault fault = Fault::None;
  std::string detail;  ///< device and system message; may be empty
};

/// A device's value, or the fault to report.
template <class T = void>
using DeviceResult = tl::expected<T, FaultReport>;

}  // namespace orbwatch::hal
