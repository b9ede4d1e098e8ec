// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace orbwatch::app {

/// A TCP port that an interface listens on.
struct ListeningPort {
  std::string_view interface;  ///< table of the configuration
  std::string_view key;        ///< in the table, that states the port
  std::string address;         ///< numeric; 0.0.0.0 or ::, all of the computer's
  int port = 0;                ///< 0: any free one
};

}  // namespace orbwatch::app
