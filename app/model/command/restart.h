// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "proc/image/result.h"

namespace orbwatch::app {

/// Restart of the program with its files read again. Both members may be called on any thread.
struct Restart {
  /// Checks that the files can run; waits for the disk and for the checks of a whole configuration.
  /// Error: the reason, already logged.
  std::function<Result<>()> check;
  /// Requests it and returns. For files that passed check().
  std::function<void()> request;
};

}  // namespace orbwatch::app
