// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tl/expected.hpp>
#include <vector>

#include "app/ports/modbus/map/register_map.h"

namespace orbwatch::app::modbus {

/// Exception codes of the Modbus Application Protocol (V1.1b3, 7).
enum class Exception : std::uint8_t {
  IllegalFunction = 1,
  IllegalDataAddress = 2,
  IllegalDataValue = 3,
  GatewayTargetFailed = 11,
};

/// Consecutive registers or bits.
struct Range {
  Table table = Table::Input;
  int address = 0;
  int count = 0;
};

/// A write request: one value per register or bit.
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

/// A well-formed request of function code 1 to 6, 15, 16, 22 or 23.
struct Request {
  std::optional<Range> read{};
  std::optional<Write> write{};
  std::optional<MaskWrite> mask{};  ///< converted to `write` with the register's content
};

/// Parses a protocol data unit (function code first, at least one byte). Errors: an unsupported
/// function; a quantity out of range, or a length that contradicts it. Reentrant.
tl::expected<Request, Exception> parse(std::span<const std::uint8_t> pdu);

/// The length of the protocol data unit that begins with these bytes, function code first. Some
/// functions state it in byte 6 or 10; before that byte the result is 6 or 10. nullopt: an
/// unsupported function. Reentrant.
std::optional<std::size_t> request_length(std::span<const std::uint8_t> pdu);

/// Computes the write from a mask and the register's present content; unchecked. Reentrant.
Write resolved(const MaskWrite& mask, const RegisterMap& map, const ProcessImage& image);

/// Checks a read; an unmapped place gives IllegalDataAddress. Reentrant.
std::optional<Exception> check(const Range& read, const RegisterMap& map);

/// True: the write concerns the state of the machine. Reentrant.
bool writes_machine_state(const Range& range);

/// Checks a write; a read-only place, half of a 32-bit value or a part of the machine's state gives
/// IllegalDataAddress, a value outside the row's range IllegalDataValue. Values of the machine's
/// state are left to take_machine_state(). Reentrant.
std::optional<Exception> check(const Write& write, const RegisterMap& map);

/// Executes a checked write.
void apply(const Write& write, const RegisterMap& map, PlcRegisters& registers);

}  // namespace orbwatch::app::modbus
