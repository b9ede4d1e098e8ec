// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "app/model/status/utc_text.h"

namespace orbwatch::app::web {

/// One entry of the audit: an action and its origin.
struct AuditEntry {
  std::chrono::system_clock::time_point time{};
  std::string who;   ///< name of a user or a token; empty: not logged in
  std::string from;  ///< numeric address, or the interface without addresses
  std::string what;  ///< a command's name, else the route's
  std::string before{};
  std::string after{};
  std::string result;  ///< "done", or the reason of a refusal
};
/// Written only; the time is a text.
template <class Visitor>
void visit(Visitor& v, AuditEntry& entry) {
  std::string time = utc_text(entry.time).value_or("");
  v.required("time", time, "UTC in ISO 8601");
  v.required("who", entry.who, "Name of a user or a program; empty: not logged in");
  v.required("from", entry.from,
             "Numeric address; of commands that were not given over HTTP the interface: over "
             "Modbus, or over DDS and the client's number");
  v.required("what", entry.what, "Name of a command, else last part of the path");
  v.required("before", entry.before, "Values before the change");
  v.required("after", entry.after, "Values after the change");
  v.required("result", entry.result, "done, or the reason of a refusal");
}

}  // namespace orbwatch::app::web
