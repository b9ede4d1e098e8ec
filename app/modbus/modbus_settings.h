#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace orbwatch::app {

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
  /// Numeric addresses of the clients that may write; empty: all of them.
  std::vector<std::string> writers;

  /// From the first byte of a request to its last.
  std::chrono::milliseconds frame_timeout{1000};
  /// Without a request.
  std::chrono::milliseconds idle_timeout{60000};
  /// Without word from the pipeline, which promises ten a second; then nothing it said is served
  /// as valid any more.
  std::chrono::milliseconds status_timeout{2000};
};

}  // namespace orbwatch::app
