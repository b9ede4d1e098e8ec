#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "app/commands.h"
#include "app/dds/idl/command.h"

namespace orbwatch::app {

using CommandMessage = orbwatch_msgs_msg_dds__Command_;
using CommandResultMessage = orbwatch_msgs_msg_dds__CommandResult_;

/// What names a request: whose it is, and which of them.
struct RequestId {
  std::uint64_t client = 0;
  std::uint64_t number = 0;

  bool operator==(const RequestId&) const = default;
};

/// A request as it came, cut to what any command could need.
struct CommandRequest {
  RequestId id;
  std::string name;
  std::array<double, kMaxArguments> arguments{};
  std::size_t argument_count = 0;  ///< as sent
};

/// The answer to a request, as it goes to the client.
struct CommandAnswer {
  CommandResult result = CommandResult::Done;
  std::string text;  ///< one line

  bool operator==(const CommandAnswer&) const = default;
};

/// Takes a message from the network over; reads no more of it than any command could need.
CommandRequest request_of(const CommandMessage& message);

/// Carries a request out by `handler` on this thread, or says why not: a number of the id is 0, no
/// such command, not its arguments. Nothing of the sender's text is repeated.
CommandAnswer carry_out(const CommandRequest& request, const CommandHandler& handler);

}  // namespace orbwatch::app
