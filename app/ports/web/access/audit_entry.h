#pragma once

#include <chrono>
#include <string>

namespace orbwatch::app::web {

/// One line of the audit: who did what.
struct AuditEntry {
  std::chrono::system_clock::time_point time{};
  std::string who;   ///< name of a user or a token; empty: nobody by name
  std::string from;  ///< numeric address
  std::string what;  ///< a command's name, else the route's
  std::string before{};
  std::string after{};
  std::string result;  ///< "done", or why not
};

}  // namespace orbwatch::app::web
