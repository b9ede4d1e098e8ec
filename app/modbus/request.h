#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tl/expected.hpp>
#include <vector>

#include "app/modbus/register_map.h"

namespace orbwatch::app::modbus {

/// Why a request is refused, with the numbers of the Modbus Application Protocol (V1.1b3, 7).
enum class Exception : std::uint8_t {
  IllegalFunction = 1,
  IllegalDataAddress = 2,
  IllegalDataValue = 3,
  GatewayTargetFailed = 11,
};

/// Registers or bits side by side.
struct Range {
  Table table = Table::Input;
  int address = 0;
  int count = 0;
};

/// What is to be written: one value per register or bit.
struct Write {
  Range range;
  std::vector<std::uint16_t> values;
};

/// Mask Write Register: new = (old and and_mask) or (or_mask and not and_mask).
struct MaskWrite {
  int address = 0;
  std::uint16_t and_mask = 0;
  std::uint16_t or_mask = 0;
};

/// A request of one of the function codes 1 to 6, 15, 16, 22 and 23, whose structure is right.
struct Request {
  std::optional<Range> read{};
  std::optional<Write> write{};
  std::optional<MaskWrite> mask{};  ///< becomes `write` once the register's content is known
};

/// Takes a protocol data unit (function code first, at least one byte) apart. Errors: a function
/// that is not served; a quantity out of range or a length that contradicts it. Reentrant.
tl::expected<Request, Exception> parse(std::span<const std::uint8_t> pdu);

/// How long the protocol data unit is whose beginning this is, function code first; of some
/// functions that can be said only of 6 or 10 bytes, and is that number before. None: a function
/// that is not served. Reentrant.
std::optional<std::size_t> request_length(std::span<const std::uint8_t> pdu);

/// The write that a mask comes to, given the register's content now; unchecked. Reentrant.
Write resolved(const MaskWrite& mask, const RegisterMap& map, const Snapshot& now);

/// Every place must be mapped, or it is IllegalDataAddress. Reentrant.
std::optional<Exception> check(const Range& read, const RegisterMap& map);

/// Every place must be writable and 32-bit values written whole, or it is IllegalDataAddress;
/// values outside the row's range are IllegalDataValue. Reentrant.
std::optional<Exception> check(const Write& write, const RegisterMap& map);

/// Carries out a write that was checked.
void apply(const Write& write, const RegisterMap& map, PlcRegisters& registers);

}  // namespace orbwatch::app::modbus
