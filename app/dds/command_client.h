#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "app/commands.h"
#include "app/dds/command_request.h"
#include "app/dds/security/participant_security.h"
#include "proc/image/result.h"

namespace orbwatch::app {

struct CommandOptions {
  int domain = 0;                              ///< DDS domain, 0 to 230
  std::string prefix = "orbwatch";             ///< of the topics
  std::chrono::milliseconds timeout{5000};     ///< to find orbwatchd and to get its answer
  std::optional<SecuritySettings> security{};  ///< needed where orbwatchd has it
};

/// Sends a command, whose code has to be one of kCommands, over DDS and waits for its answer. The
/// request is repeated until the answer comes, which does not repeat the command. Thread-bound;
/// `cancelled` is looked at ten times a second. Errors: nobody takes commands there, no answer in
/// time, an answer that nobody knows, no usable network interface.
Result<CommandAnswer> send_command(const CommandOptions& options, const Command& command,
                                   const std::atomic<bool>& cancelled);

}  // namespace orbwatch::app
