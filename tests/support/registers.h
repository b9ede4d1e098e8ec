// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace orbwatch::tests {

/// Reads one register of a Modbus server, found by its name in the committed manual
/// app/ports/modbus/registers.csv, with libmodbus like a PLC; INT64_MIN while the server does not
/// answer. Unscaled.
std::int64_t read_register(int port, const std::string& name,
                           const std::string& host = "127.0.0.1");

/// Writes arguments (value / scale), then a command and a new sequence, and waits until it is
/// acknowledged, also over a restart of the server.
void write_command(int port, std::uint16_t code, const std::vector<std::int32_t>& arguments,
                   std::uint16_t sequence);

}  // namespace orbwatch::tests
