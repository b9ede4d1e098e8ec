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

namespace orbwatch::app {

struct SubscribeOptions {
  int domain = 0;                              ///< DDS domain, 0 to 230
  std::optional<SecuritySettings> security{};  ///< required where orbwatchd has it
  std::string prefix = "orbwatch";             ///< of the default topics; left out of file names
  /// With or without "rt/". None: the selected view and the process state.
  std::vector<std::string> topics{};
  std::filesystem::path save{};  ///< folder for the newest image of each topic, made if missing
  double seconds = 0;            ///< 0: until cancelled
  int count = 0;                 ///< samples of each topic that are enough; 0: never
  bool stats = false;            ///< a line per topic and second
  bool each = false;             ///< a line per sample
  bool json = false;             ///< of these lines, for programs
};

/// Reads topics until the time is over, each has brought `count` or `cancelled` is set, and saves
/// the newest images at the end. Topics that end in /process_state carry process states, in
/// /compressed JPEG pictures, all others images; invalid samples are refused and counted. Lines go
/// to `out`. Returns an entry per topic, in the order asked for. Thread-bound; `cancelled` is
/// checked ten times a second. Errors: a topic twice, no usable network interface, a topic that is
/// written with another type only, after WriterTypes::kDiscovery, a file that cannot be written.
Result<std::vector<TopicReport>> subscribe(const SubscribeOptions& options,
                                           const std::atomic<bool>& cancelled, std::ostream& out);

}  // namespace orbwatch::app
