#pragma once

#include <cstdint>
#include <string>

namespace orbwatch::tests {

/// One register of a Modbus server on loopback, found by its name in the committed manual
/// app/modbus/registers.csv and read with libmodbus as a PLC would; INT64_MIN while nobody answers.
/// Unscaled.
std::int64_t read_register(int port, const std::string& name);

/// Writes a command, its argument and a new sequence in one request.
void write_command(int port, std::uint16_t code, std::int32_t argument, std::uint16_t sequence);

}  // namespace orbwatch::tests
