#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace orbwatch::app {

enum class Parity : std::uint8_t { None, Even, Odd };

/// What the kernel has a speed for and libmodbus knows, in bits per second.
inline constexpr std::array kBaudRates{1200,  2400,   4800,   9600,   19200, 38400,
                                       57600, 115200, 230400, 460800, 921600};

/// The [modbus.serial] part of the site file: Modbus RTU. The defaults are the standard's.
struct ModbusSerialSettings {
  /// The line's device; of an adapter on USB best the link in /dev/serial/by-id.
  std::string device;
  int baud_rate = 19200;  ///< one of kBaudRates
  Parity parity = Parity::Even;
  int stop_bits = 1;
  int unit_id = 1;  ///< 1 to 247
  bool may_write = true;
};

/// The [modbus] part of the site file.
struct ModbusSettings {
  bool enabled = true;
  /// The numeric IPv4 or IPv6 address to listen on. All interfaces by default: the PLC is always
  /// another machine, so listening on loopback would serve nobody. Modbus knows no passwords: on a
  /// device with more than one network name the machine network's address here.
  std::string address = "0.0.0.0";
  /// Not the registered port 502, which needs CAP_NET_BIND_SERVICE. 0: any free port.
  int port = 1502;
  /// When one more client comes, the one that has been quiet for the longest time goes.
  int max_connections = 16;
  /// Numeric addresses or prefixes (10.0.0.0/24, fd00::/8) of the clients that may read; empty: all
  /// of them.
  std::vector<std::string> readers;
  /// Of those that may write, and read; empty: all that may read.
  std::vector<std::string> writers;
  /// The units that are answered. Over TCP the unit only matters behind a gateway: 255 is
  /// recommended, 0 accepted (Modbus Messaging on TCP/IP Implementation Guide), and 1 is what most
  /// clients send unless told otherwise. Requests for others were meant for another device.
  std::vector<int> unit_ids{0, 1, 255};
  /// A serial line beside TCP.
  std::optional<ModbusSerialSettings> serial;

  /// For how long the PLC's heartbeat may stand still; 0: it is not watched.
  double plc_timeout_ms = 0;

  /// From the first byte of a request to its last.
  std::chrono::milliseconds frame_timeout{1000};
  /// Without a request.
  std::chrono::milliseconds idle_timeout{60000};
  /// Without word from the pipeline, which promises ten a second; then nothing it said is served
  /// as valid any more.
  std::chrono::milliseconds status_timeout{2000};
};

}  // namespace orbwatch::app
