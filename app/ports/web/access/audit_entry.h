// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

namespace orbwatch::app::web {

/// One line of the audit: an action and its origin.
struct AuditEntry {
  std::chrono::system_clock::time_point time{};
  std::string who;   ///< name of a user or a token; empty: not logged in
  std::string from;  ///< numeric address
  std::string what;  ///< a command's name, else the route's
  std::string before{};
  std::string after{};
  std::string result;  ///< "done", or the reason of a refusal
};

}  // namespace orbwatch::app::web
