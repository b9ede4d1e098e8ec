#pragma once

#include <chrono>
#include <filesystem>

#include "proc/image/result.h"

namespace orbwatch::app {

/// Time that a daemon may take.
struct TrialPatience {
  std::chrono::milliseconds taken{30'000};     ///< from the request to its being taken up
  std::chrono::milliseconds started{180'000};  ///< from then on, as the service manager grants it
};

/// Waits until the daemon that has the state folder `folder` runs the trial that was requested
/// there. Error: why it does not; a request that no daemon took up is withdrawn. Reentrant.
Result<> await_trial(const std::filesystem::path& folder, const TrialPatience& patience = {});

}  // namespace orbwatch::app
