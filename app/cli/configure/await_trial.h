// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// Time limits for a daemon.
struct TrialPatience {
  std::chrono::milliseconds taken{30'000};  ///< from the request until a daemon accepts it
  std::chrono::milliseconds started{
      180'000};  ///< from then on, as long as the service manager permits
};

/// Waits until the daemon that has the state folder `folder` runs the trial that was requested
/// there. Error: the reason why it does not, which may name `unit`, see unit_of(); a request that
/// no daemon accepted is withdrawn. Reentrant.
Result<> await_trial(const std::filesystem::path& folder, const std::string& unit,
                     const TrialPatience& patience = {});

}  // namespace orbwatch::app::cli
