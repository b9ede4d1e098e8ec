#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/dds/command_counts.h"
#include "app/dds/idl/diagnostics.h"
#include "app/dds/time_message.h"
#include "app/pipeline/status_report.h"

namespace orbwatch::app {

using DiagnosticsMessage = diagnostic_msgs_msg_dds__DiagnosticArray_;

/// Where ROS 2 looks for diagnostics, whoever they are of; about one message a second.
inline constexpr const char* kDiagnosticsTopic = "rt/diagnostics";

/// The numbers are those of diagnostic_msgs/msg/DiagnosticStatus.
enum class DiagnosticLevel : std::uint8_t { Ok = 0, Warn = 1, Error = 2, Stale = 3 };

/// One line of diagnostics.
struct Diagnostic {
  DiagnosticLevel level = DiagnosticLevel::Ok;
  std::string name;     ///< "orbwatch: camera left"
  std::string message;  ///< one line for operators
  std::vector<std::pair<std::string, std::string>> values;
};

/// What a status says of how orbwatch is: as a whole, and each camera, view, region, alarm, the
/// board, the commands. Keys are the names of status_fields.h, with the unit in parentheses. What
/// the process does is no diagnostic: signals are left to the process state. Stale: nothing is
/// known (yet). Reentrant.
std::vector<Diagnostic> diagnose(const StatusReport& report, const CommandCounts& commands);

/// Turns diagnostics into a message, in memory that is used again. Thread-bound.
class DiagnosticsComposer {
 public:
  /// `hardware_id` tells appliances apart.
  explicit DiagnosticsComposer(std::string hardware_id) : hardware_id_(std::move(hardware_id)) {}

  /// The message; valid until the next call. `stamp` is now.
  const DiagnosticsMessage& compose(std::vector<Diagnostic> diagnostics, const TimeMessage& stamp);

 private:
  std::string hardware_id_;
  std::string frame_id_;  ///< empty: diagnostics are of no place
  std::vector<Diagnostic> diagnostics_;
  std::vector<diagnostic_msgs_msg_dds__KeyValue_> values_;
  std::vector<diagnostic_msgs_msg_dds__DiagnosticStatus_> entries_;
  DiagnosticsMessage message_{};
};

}  // namespace orbwatch::app
