// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// A call of `orbwatch`, the program that comes with this one. Work that only it can do, with
/// archives of any origin among it, thus takes memory of its own and cannot end the daemon.
struct CliCall {
  std::vector<std::string> arguments;
  std::string secret{};  ///< readable at kChildSecret; empty: none
  std::chrono::milliseconds time = std::chrono::minutes(2);
  const hal::EventFd* cancelled = nullptr;  ///< see ChildCall
};

/// Runs it for the configuration file `config`. Returns its standard output. Error: its message; as
/// run_child(). Not while the environment is changed.
Result<std::string> run_cli(const std::filesystem::path& config, const CliCall& call);

}  // namespace orbwatch::app::daemon
