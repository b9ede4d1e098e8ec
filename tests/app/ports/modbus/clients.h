// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/modbus/modbus_sink.h"
#include "tests/support/raw_client.h"

struct _modbus;  // name in libmodbus' header

namespace orbwatch::app::tests {

using orbwatch::tests::Bytes;
using orbwatch::tests::RawClient;
using orbwatch::tests::Unconnected;
using Words = std::vector<std::uint16_t>;

/// A loopback server on a free port. Timeouts are practically disabled, so that a slow machine
/// cannot fail a test of other behaviour.
ModbusSettings loopback();

/// A command handler that answers Done to every command.
CommandResult accept_all(const Command& command);

/// A status whose figures differ from each other and from 0.
Status example_status();

/// Address of the register or discrete input of this name, not of its mirror. Throws
/// std::out_of_range for an unknown name.
int address_of(std::string_view name);
int bit_of(std::string_view name);

/// Addresses of the first and the last register of a command, and of its acknowledgement.
inline const int kArguments = address_of("argument_0");
inline const int kSequence = address_of("command_sequence");
inline const int kAcknowledged = address_of("acknowledged_sequence");

/// All registers that a PLC writes for the command select_view, from the first argument to the
/// sequence.
inline Words select_view(std::uint16_t view, std::uint16_t sequence) {
  return {0, view, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, sequence};
}

/// Index of a register in an answer that begins with another one.
inline std::size_t place_of(std::string_view name, std::string_view first) {
  return static_cast<std::size_t>(address_of(name) - address_of(first));
}

/// A PLC, by libmodbus. Results are exception codes, 0: none, -1: the connection failed.
class Plc {
 public:
  explicit Plc(int port, int unit = 1, const std::string& server = "127.0.0.1");
  /// Connects on a serial line of 19200 bit/s without parity.
  Plc(const std::string& line, int unit);

  int read_bits(int address, int count);
  int read_discrete(int address, int count);
  int read_holding(int address, int count);
  int read_input(int address, int count);
  int write(int address, std::uint16_t value);
  int write(int address, const Words& values);
  /// Writes values that end with a sequence, and waits until it is acknowledged.
  int command(int address, const Words& values);
  int mask_write(int address, std::uint16_t and_mask, std::uint16_t or_mask);
  int write_and_read(int write_address, const Words& values, int read_address, int count);
  int write_coil(int address);
  int write_coils(int address, int count);

  /// Result of the last read.
  std::vector<std::uint8_t> bits;
  Words words;
  /// 32-bit value, high word first, from words[place] on.
  std::uint32_t u32(std::size_t place) const;
  std::int32_t i32(std::size_t place) const { return static_cast<std::int32_t>(u32(place)); }

 private:
  struct Close {
    void operator()(_modbus* context) const;
  };
  void connect(int unit);
  int outcome(int result) const;
  std::unique_ptr<_modbus, Close> context_;
};

/// One complete answer without its MBAP header and unit; empty: the connection ended.
Bytes receive_pdu(RawClient& client);

/// A frame with its MBAP header.
Bytes frame(const Bytes& pdu, std::uint8_t unit = 1, std::uint16_t transaction = 0x1234);

/// A frame for a serial line, with its checksum.
Bytes rtu_frame(int unit, const Bytes& pdu);

/// Yields until the condition holds; false after a minute.
bool eventually(const std::function<bool()>& condition);

}  // namespace orbwatch::app::tests
