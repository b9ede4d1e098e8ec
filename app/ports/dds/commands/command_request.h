// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "app/model/command/command.h"
#include "app/ports/dds/generated/command.h"
#include "app/state/command_record.h"

namespace orbwatch::app::dds {

using CommandMessage = orbwatch_msgs_msg_dds__Command_;
using CommandResultMessage = orbwatch_msgs_msg_dds__CommandResult_;

/// Identifies a request.
using RequestId = CommandId;

/// A request as received, cut to the longest length that any command needs.
struct CommandRequest {
  RequestId id;
  std::string name;
  std::array<double, kMaxArguments> arguments{};
  std::size_t argument_count = 0;  ///< number of arguments sent
};

/// The answer to a request.
struct CommandAnswer {
  CommandResult result = CommandResult::Done;
  std::string text;  ///< one line

  bool operator==(const CommandAnswer&) const = default;
};

/// Copies a message from the network, at most as much as any command needs.
CommandRequest request_of(const CommandMessage& message);

/// Executes a request by `handler` on this thread, or refuses it: a number of the id is 0, the
/// command is unknown, or its arguments are not allowed. The answer does not quote the sender.
CommandAnswer carry_out(const CommandRequest& request, const CommandHandler& handler);

}  // namespace orbwatch::app::dds
