// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/model/status/status_report.h"
#include "app/ports/dds/generated/diagnostics.h"
#include "app/ports/dds/participant/time_message.h"
#include "app/ports/dds/status/dds_statistics.h"

namespace orbwatch::app::dds {

using DiagnosticsMessage = diagnostic_msgs_msg_dds__DiagnosticArray_;

/// Topic of all diagnostics in ROS 2; one message per second is usual.
inline constexpr const char* kDiagnosticsTopic = "rt/diagnostics";

/// Level of a diagnostic; the numbers are those of diagnostic_msgs/msg/DiagnosticStatus and of
/// Severity.
enum class DiagnosticLevel : std::uint8_t { Ok = 0, Warn = 1, Error = 2, Stale = 3 };

/// One line of diagnostics.
struct Diagnostic {
  DiagnosticLevel level = DiagnosticLevel::Ok;
  std::string name;     ///< "orbwatch: camera left"
  std::string message;  ///< one line for operators
  std::vector<std::pair<std::string, std::string>> values;
};

/// The condition of each component of a status, of the commands and of the network. Keys are the
/// names of the figures with the unit in parentheses. Signals are in the process state only:
/// diagnostics concern the appliance, not the process. Stale: nothing is known yet. Reentrant.
std::vector<Diagnostic> diagnose(const StatusReport& report, const DdsStatistics& network);

/// The line "orbwatch: network": each count of samples by its reason, without counts of 0. Warn if
/// samples were lost or refused. Reentrant.
Diagnostic diagnose_network(const DdsStatistics& network);

/// Turns diagnostics into a message. Thread-bound; reuses its memory.
class DiagnosticsComposer {
 public:
  /// `hardware_id` distinguishes appliances.
  explicit DiagnosticsComposer(std::string hardware_id) : hardware_id_(std::move(hardware_id)) {}

  /// The message; valid until the next call. `stamp` is the present time.
  const DiagnosticsMessage& compose(std::vector<Diagnostic> diagnostics, const TimeMessage& stamp);

 private:
  std::string hardware_id_;
  std::string frame_id_;  ///< empty: diagnostics belong to no frame
  std::vector<Diagnostic> diagnostics_;
  std::vector<diagnostic_msgs_msg_dds__KeyValue_> values_;
  std::vector<diagnostic_msgs_msg_dds__DiagnosticStatus_> entries_;
  DiagnosticsMessage message_{};
};

}  // namespace orbwatch::app::dds
