#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

namespace orbwatch::app {

/// What the outside may ask for. The numbers go to PLC and controller: append, never renumber.
enum class CommandCode : std::uint16_t {
  SelectView = 1,
  Pulse = 2,
  Start = 3,
  Stop = 4,
  SelectRecipe = 5,
  PointView = 6,
  MixSources = 7,
  Trigger = 8,
  AcknowledgeAlarm = 9,
  Snapshot = 10,
  SetProcessActive = 11,
  Restart = 12,
};

inline constexpr std::size_t kMaxArguments = 4;

/// One argument of a command. Interfaces that know integers only send value / scale.
struct ArgumentInfo {
  std::string_view name{};  ///< empty: there is none
  std::string_view unit{};
  double scale = 1;  ///< 1: a whole number
  double minimum = 0;
  double maximum = 0;
  std::string_view description{};
};

/// The facts about one command, for every interface that offers it.
struct CommandInfo {
  CommandCode code;
  std::string_view name;
  std::string_view description;
  std::array<ArgumentInfo, kMaxArguments> arguments{};

  constexpr std::size_t argument_count() const {
    std::size_t count = 0;
    while (count < kMaxArguments && !arguments[count].name.empty()) ++count;
    return count;
  }
};

inline constexpr double kAnyIndex = std::numeric_limits<std::uint16_t>::max();

inline constexpr ArgumentInfo kViewArgument{"view", "",        1,
                                            0,      kAnyIndex, "index of the view, from 0"};

/// Every command. What an argument may be beyond its range depends on the configuration.
inline constexpr std::array kCommands{
    CommandInfo{CommandCode::SelectView,
                "select_view",
                "Shows this view on the topic of the selected view",
                {kViewArgument}},
    CommandInfo{CommandCode::Pulse,
                "pulse",
                "One pulse on this line",
                {{{"line", "", 1, 0, kAnyIndex, "index of the trigger_out line, from 0"}}}},
    CommandInfo{CommandCode::Start, "start", "Measures again"},
    CommandInfo{CommandCode::Stop, "stop", "Stops measuring; views are published on"},
    CommandInfo{CommandCode::SelectRecipe,
                "select_recipe",
                "Measures by this recipe from the next frame set on",
                {{{"recipe", "", 1, 1, kAnyIndex, "number of the recipe"}}}},
    CommandInfo{CommandCode::PointView,
                "point_view",
                "Turns a display view elsewhere",
                {{kViewArgument,
                  {"yaw", "deg", 0.01, -180, 180, "from +Y towards +X"},
                  {"pitch", "deg", 0.01, -90, 90, "up positive"},
                  {"h_fov", "deg", 0.01, 0, 360, "horizontal field of view; 0 keeps it"}}}},
    CommandInfo{CommandCode::MixSources,
                "mix_sources",
                "Gives a camera another share of a display view",
                {{kViewArgument,
                  {"source", "", 1, 0, kAnyIndex, "index among the view's sources, from 0"},
                  {"weight", "", 0.001, 0.001, 1000, "its share where others see too"}}}},
    CommandInfo{CommandCode::Trigger, "trigger",
                "Measures the next frame set as a result, as an edge of the trigger line would"},
    CommandInfo{CommandCode::AcknowledgeAlarm,
                "acknowledge_alarm",
                "Acknowledges one alarm or all",
                {{{"alarm", "", 1, 0, kAnyIndex, "number of the alarm, from 1; 0: all"}}}},
    CommandInfo{CommandCode::Snapshot,
                "snapshot",
                "Writes the next picture of a view into the snapshot folder",
                {kViewArgument}},
    CommandInfo{CommandCode::SetProcessActive,
                "set_process_active",
                "Says whether the process runs, where the recipe lets the PLC say so",
                {{{"active", "", 1, 0, 1, "1: it runs"}}}},
    CommandInfo{CommandCode::Restart, "restart",
                "Ends orbwatchd in order and starts it again with its files read again"},
};

/// One of them with its arguments, each in the argument's unit.
struct Command {
  CommandCode code = CommandCode::SelectView;
  std::array<double, kMaxArguments> arguments{};
};

/// The answer to a command; the numbers go to the PLC.
enum class CommandResult : std::uint16_t {
  Done = 0,
  UnknownCommand = 1,
  ArgumentOutOfRange = 2,
  Busy = 3,         ///< not now; it can be repeated
  NotPossible = 4,  ///< not with this configuration, however often it is repeated
};

/// The one place of the operator's text for each result. Empty for a number that is none.
constexpr std::string_view operator_text(CommandResult result) {
  switch (result) {
    case CommandResult::Done:
      return "done";
    case CommandResult::UnknownCommand:
      return "unknown command";
    case CommandResult::ArgumentOutOfRange:
      return "argument out of range";
    case CommandResult::Busy:
      return "busy: try again";
    case CommandResult::NotPossible:
      return "not possible with this configuration";
  }
  return {};
}

/// The facts about a code or a name, or nullptr when there is no such command. Reentrant.
const CommandInfo* find_command(CommandCode code);
const CommandInfo* find_command(std::string_view name);

/// What can be told without the configuration: the command is known and its arguments are in range,
/// whole numbers where they must be. Done: it may be carried out. Reentrant.
CommandResult check(const Command& command);

/// What an argument may be: "-180 to 180 deg", "a whole number, 0 to 1". Reentrant.
std::string range_text(const ArgumentInfo& argument);

/// Why check() lets a command not pass, in one line: "yaw is 200; it must be -180 to 180 deg".
/// Empty when it does. Reentrant.
std::string refusal_text(const Command& command);

/// An argument that check() let pass, as an index or number.
inline std::size_t whole(const Command& command, std::size_t argument) {
  return static_cast<std::size_t>(command.arguments[argument]);
}

/// Carries a command out that check() let pass; called by sinks on their own threads. Thread-safe,
/// does not wait.
using CommandHandler = std::function<CommandResult(const Command&)>;

}  // namespace orbwatch::app
