#pragma once

#include <functional>

#include "proc/image/result.h"

namespace orbwatch::app {

/// A new start of the program with its files read again. Both on any thread.
struct Restart {
  /// Checks that the files say what can run; waits for the disk and for the checks of a whole
  /// configuration. Error: why not, which was logged.
  std::function<Result<>()> check;
  /// Requests it and returns. For files that passed check().
  std::function<void()> request;
};

}  // namespace orbwatch::app
