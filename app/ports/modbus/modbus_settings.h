// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/command/command_path.h"
#include "app/model/machine/machine_state.h"
#include "app/model/sink/listening_port.h"
#include "app/model/sink/sink.h"
#include "app/ports/modbus/server/access_list.h"
#include "hal/network.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

enum class Parity : std::uint8_t { None, Even, Odd };

/// Speeds that both the kernel and libmodbus support, bits per second.
inline constexpr std::array kBaudRates{1200,  2400,   4800,   9600,   19200, 38400,
                                       57600, 115200, 230400, 460800, 921600};

/// The [modbus.serial] part of the site file: Modbus RTU. The defaults are those of the standard.
struct ModbusSerialSettings {
  /// Device of the line; preferably the link in /dev/serial/by-id for an adapter on USB.
  std::string device;
  int baud_rate = 19200;  ///< one of kBaudRates
  Parity parity = Parity::Even;
  int stop_bits = 1;
  int unit_id = 1;  ///< 1 to 247
  bool may_write = true;
};

/// The [modbus] part of the site file.
struct ModbusSettings {
  static constexpr std::string_view kName = "modbus", kText = "Modbus server for the PLC";

  bool enabled = true;
  /// Numeric IPv4 or IPv6 address to listen on. Default: all interfaces, because the PLC is always
  /// another machine. Modbus has no passwords: on a device in more than one network set the address
  /// in the machine network.
  std::string address = "0.0.0.0";
  /// TCP port; the default is not the registered port 502, which needs CAP_NET_BIND_SERVICE. 0: any
  /// free port.
  int port = 1502;
  /// Limit of connections; idle ones stay while there is room, and a further client closes one in
  /// the order of TcpServer::has_room_for().
  int max_connections = 16;
  /// Time without a packet after which TCP keep-alive probes the client, s.
  int keep_alive_s = 60;
  /// Numeric addresses or prefixes (10.0.0.0/24, fd00::/8) of the clients that may read; empty: all
  /// clients.
  std::vector<std::string> readers;
  /// Addresses or prefixes of clients that may read and write; empty: this host only.
  std::vector<std::string> writers;
  /// The units that are answered. Over TCP the unit only matters behind a gateway: 255 is
  /// recommended, 0 accepted (Modbus Messaging on TCP/IP Implementation Guide), and 1 is the
  /// default of most clients. Requests for other units are meant for another device.
  std::vector<int> unit_ids{0, 1, 255};
  /// Serial line besides TCP.
  std::optional<ModbusSerialSettings> serial;

  /// Longest time without a change of the PLC's heartbeat; 0: not supervised.
  double plc_timeout_ms = 0;

  /// Limit from the first byte of a request to its last.
  std::chrono::milliseconds frame_timeout{1000};
  /// Idle time after which a reader may displace a writer's connection.
  std::chrono::milliseconds idle_time{60000};
  /// Silence of the pipeline, which reports ten times a second, after which its values are no
  /// longer served as valid.
  std::chrono::milliseconds status_timeout{2000};
};

inline constexpr std::array kParities{Word{"none", Parity::None}, Word{"even", Parity::Even},
                                      Word{"odd", Parity::Odd}};

template <class Visitor>
void visit(Visitor& v, ModbusSerialSettings& serial) {
  v.required("device", serial.device,
             "Device of the serial line, preferably a link in /dev/serial/by-id");
  v.optional("baud_rate", serial.baud_rate, Range::between(1200, 921600), "Bits per second");
  v.require(std::ranges::count(kBaudRates, serial.baud_rate) == 1, "baud_rate",
            "is not a standard baud rate such as 9600, 19200, 38400, 57600 or 115200");
  v.optional("parity", serial.parity, kParities, "Parity; none usually requires 2 stop bits");
  v.optional("stop_bits", serial.stop_bits, Range::between(1, 2), "Stop bits per character");
  v.optional("unit_id", serial.unit_id, Range::between(1, 247),
             "Unit identifier that is served, besides broadcasts to unit 0");
  v.optional("may_write", serial.may_write, "Masters on this line may write");
}

template <class Visitor>
void visit(Visitor& v, ModbusSettings& modbus) {
  v.optional("enabled", modbus.enabled, "Serve Modbus");
  v.optional("address", modbus.address, "Numeric address to listen on");
  // The network interface of a zone (fe80::1%eth0) may be plugged in later.
  const std::string host = modbus.address.substr(0, modbus.address.find('%'));
  v.require(!modbus.enabled || hal::parse_host(host).has_value(), "address",
            "is not a numeric address such as 192.168.1.20, 0.0.0.0 or ::1");
  v.optional("port", modbus.port, Range::between(0, 65535), "TCP port; 0: any free port");
  v.optional("max_connections", modbus.max_connections, Range::between(1, 1000),
             "Limit of open connections; a further client closes one: readers before writers, "
             "those without a request first, then those of the host with the most connections, "
             "then the one idle longest; a reader closes no writer with a request in the last "
             "60 s");
  v.optional("keep_alive_s", modbus.keep_alive_s, Range::between(1, 7200),
             "Idle time after which TCP keep-alive probes a client; without an answer its "
             "connection is closed 30 s later");
  v.optional("readers", modbus.readers,
             "Numeric addresses or prefixes (10.0.0.0/24) of clients that may read; []: all");
  hal::require_networks(v, "readers", modbus.readers);
  v.optional(
      "writers", modbus.writers,
      "Numeric addresses or prefixes of clients that may read and write; []: this host only");
  hal::require_networks(v, "writers", modbus.writers);
  v.optional("unit_ids", modbus.unit_ids, Range::between(0, 255),
             "Unit identifiers that are answered; requests for others get exception 11");
  v.require(!modbus.unit_ids.empty(), "unit_ids",
            "is empty, so no request would be answered; set at least one unit, as [1]");
  v.table("serial", modbus.serial, "Modbus RTU on a serial line, beside TCP");
  v.optional("plc_timeout_ms", modbus.plc_timeout_ms, Range::between(0, 60000),
             "Longest time without a change of the PLC's heartbeat; 0: not supervised");
}

/// Clients that may command over Modbus, in words; empty: none. Reentrant.
std::string commanders(const ModbusSettings& settings);

/// The ports of an enabled server.
inline std::vector<ListeningPort> listening_ports(const ModbusSettings& settings) {
  if (!settings.enabled) return {};
  return {{ModbusSettings::kName, "port", settings.address, settings.port}};
}

std::unique_ptr<Sink> make_sink(const ModbusSettings& settings, const CommandPath& commands,
                                const MachinePath& machine);

}  // namespace orbwatch::app
