#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app {

/// What the outside may ask for. The numbers are Modbus command codes: append, never renumber.
enum class CommandCode : std::uint16_t {
  SelectView = 1,
  Pulse = 2,
};

/// The facts about one command, for every interface that offers it.
struct CommandInfo {
  CommandCode code;
  std::string_view name;
  std::string_view argument;
  std::string_view description;
};

inline constexpr std::array kCommands{
    CommandInfo{CommandCode::SelectView, "select_view", "index of the view, from 0",
                "Shows this view on the topic of the selected view"},
    CommandInfo{CommandCode::Pulse, "pulse", "index of the trigger_out line, from 0",
                "One pulse on this line"},
};

struct Command {
  CommandCode code = CommandCode::SelectView;
  std::int32_t argument = 0;
};

/// The answer to a command; the numbers go to the PLC.
enum class CommandResult : std::uint16_t {
  Done = 0,
  UnknownCommand = 1,
  ArgumentOutOfRange = 2,
  Busy = 3,  ///< not now; it can be repeated
};

/// Carries a command out; called by sinks on their own threads. Thread-safe, does not wait.
using CommandHandler = std::function<CommandResult(const Command&)>;

}  // namespace orbwatch::app
