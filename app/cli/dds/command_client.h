// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "app/model/command/command.h"
#include "app/ports/dds/commands/command_request.h"
#include "app/ports/dds/security/participant_security.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

struct CommandOptions {
  int domain = 0;                   ///< DDS domain, 0 to 230
  std::string prefix = "orbwatch";  ///< prefix of the topics
  std::chrono::milliseconds timeout{
      5000};  ///< limit for discovering orbwatchd and receiving its answer
  std::optional<dds::SecuritySettings> security{};  ///< required if orbwatchd has it
};

/// Sends one of kCommands over DDS and waits for its answer. The request is repeated until the
/// answer arrives, which does not repeat the command. Thread-bound; `cancelled` is checked ten
/// times a second. Errors: no orbwatchd accepts commands there, no answer in time, an unknown
/// result, no usable network interface.
Result<dds::CommandAnswer> send_command(const CommandOptions& options, const Command& command,
                                        const std::atomic<bool>& cancelled);

}  // namespace orbwatch::app::cli
