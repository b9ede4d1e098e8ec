#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace orbwatch::hal {

/// Everything that can be wrong with a camera while it runs. The numbers are what PLCs read
/// (Modbus) and controllers receive (DDS): append, never renumber.
enum class Fault : std::uint8_t {
  None = 0,
  Unplugged = 1,
  Stalled = 2,
  ReadError = 3,
  CorruptFrame = 4,
  WrongFormat = 5,
};

/// The one place of the operator's text for each fault.
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
  return "unknown camera fault";
}

/// A change of a camera's state. `Fault::None` says that it delivers again.
struct FaultReport {
  Fault fault = Fault::None;
  std::string detail;  ///< device and system message; may be empty
};

}  // namespace orbwatch::hal
