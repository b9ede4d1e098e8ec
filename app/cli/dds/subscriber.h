// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/dds/subscription.h"
#include "app/ports/dds/security/participant_security.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

struct SubscribeOptions {
  int domain = 0;                                   ///< DDS domain, 0 to 230
  std::optional<dds::SecuritySettings> security{};  ///< required if orbwatchd has it
  std::string prefix = "orbwatch";  ///< prefix of the default topics; omitted in file names
  /// Topics with or without "rt/". None: the selected view and the process state.
  std::vector<std::string> topics{};
  std::filesystem::path save{};  ///< folder for the newest image of each topic, created if missing
  double seconds = 0;            ///< 0: until cancelled
  int count = 0;                 ///< number of samples of each topic that ends the run; 0: no limit
  bool stats = false;            ///< prints a line per topic and second
  bool each = false;             ///< prints a line per sample
  bool json = false;             ///< prints these lines as JSON
};

/// Reads topics until the time is over, each has `count` samples or `cancelled` is set, and saves
/// the newest images at the end. Topics that end in /process_state carry process states, in
/// /compressed JPEG pictures, all others images; invalid samples are refused and counted. Lines go
/// to `out`. Returns an entry per topic, in the order of the request. Thread-bound; `cancelled` is
/// checked ten times a second. Errors: a topic twice, no usable network interface, a topic that is
/// written with another type only, after WriterTypes::kDiscovery, a file that cannot be written.
Result<std::vector<TopicReport>> subscribe(const SubscribeOptions& options,
                                           const std::atomic<bool>& cancelled, std::ostream& out);

}  // namespace orbwatch::app::cli
