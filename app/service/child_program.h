// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Another program, to be run to its end.
struct ChildCall {
  std::filesystem::path program{};
  std::vector<std::string> arguments{};
  std::vector<std::string> environment{};  ///< its whole environment, NAME=VALUE
  /// Bytes that it reads at kChildSecret: other than arguments and variables they are not
  /// visible to other users, and they are not on the disk. Empty: there are none.
  std::string secret{};
  std::chrono::milliseconds time{5000};
  std::size_t bytes = std::size_t{1} << 20;  ///< limit of its standard output
  /// Signalled, it ends the program; null: nothing does. Outlives the call.
  const hal::EventFd* cancelled = nullptr;
};

inline constexpr const char* kChildSecret = "/proc/self/fd/3";

/// A program's end by itself.
struct ChildEnd {
  int status = 0;  ///< exit status
  std::string output;
  std::string errors;  ///< beginning of its standard error
};

/// Runs a program in a process group of its own, without the signals that this thread blocks and
/// without other open files.
/// Errors: it cannot be started, is ended by a signal or cancelled, prints more than `bytes`, or
/// does not end in time; it and the rest of its group are killed then. Waits no longer than `time`.
/// Reentrant.
Result<ChildEnd> run_child(const ChildCall& call);

/// Entries NAME=VALUE of this process's environment, except of these names. Not while it is
/// changed.
std::vector<std::string> environment_without(const std::vector<std::string>& names);

}  // namespace orbwatch::app
