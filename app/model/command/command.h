// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include "app/model/command/giver.h"
#include "app/model/command/role.h"
#include "proc/image/picture.h"

namespace orbwatch::app {

inline constexpr std::size_t kMaxArguments = 4;

/// One argument of a command. Interfaces with integers only send value / scale.
struct ArgumentInfo {
  std::string_view name{};  ///< empty: no argument
  std::string_view unit{};
  double scale = 1;  ///< 1: an integer
  double minimum = 0;
  double maximum = 0;
  std::string_view description{};
  bool is_below_next = false;  ///< it must be less than the argument after it
};

inline constexpr double kAnyIndex = std::numeric_limits<std::uint16_t>::max();
inline constexpr ArgumentInfo kNoArgument{};
inline constexpr ArgumentInfo kCameraArgument{"camera", "",        1,
                                              0,        kAnyIndex, "index of the camera, from 0"};
/// Bound of machine coordinates, mm; 100 m exceed any machine.
inline constexpr double kMaxCoordinate = 100000;
inline constexpr ArgumentInfo coordinate_argument(std::string_view name,
                                                  std::string_view description) {
  return {name, "mm", 0.001, -kMaxCoordinate, kMaxCoordinate, description};
}
inline constexpr ArgumentInfo pixel_argument(std::string_view name, std::string_view description) {
  return {name, "px", 0.01, -kMaxSide, kMaxSide, description};
}
inline constexpr ArgumentInfo radius_argument(std::string_view name, std::string_view description) {
  return {name, "px", 0.01, 1, kMaxSide, description};
}
inline constexpr ArgumentInfo kViewArgument{"view", "",        1,
                                            0,      kAnyIndex, "index of the view, from 0"};
inline constexpr ArgumentInfo kSourceArgument{
    "source", "", 1, 0, kAnyIndex, "index among the view's sources, from 0"};
/// Bounds of a camera value (degC or percent); wider than any colour range.
inline constexpr double kLeastValue = -1000, kMostValue = 10000;

/// The list of commands: one line here, and one handler in app/daemon/dispatch.cpp, which does not
/// compile without it. Every interface offers the commands from this list. X(code, number, name,
/// role, description, arguments...): the numbers go to PLC and controller, so append and never
/// renumber. The role is the least one permitted to give the command once there are users. Limits
/// of an argument that depend on the configuration are checked by the handler.
#define ORBWATCH_COMMANDS(X)                                                                       \
  X(SelectView, 1, "select_view", Operator,                                                        \
    "Publishes this view on the topic of the selected view", kViewArgument)                        \
  X(Pulse, 2, "pulse", Integrator, "Emits one pulse on this line",                                 \
    ArgumentInfo{"line", "", 1, 0, kAnyIndex, "index of the trigger_out line, from 0"})            \
  X(Start, 3, "start", Operator, "Resumes measuring", kNoArgument)                                 \
  X(Stop, 4, "stop", Operator, "Stops measuring; views are still published", kNoArgument)          \
  X(SelectRecipe, 5, "select_recipe", Operator,                                                    \
    "Measures by this recipe from the next frame set on",                                          \
    ArgumentInfo{"recipe", "", 1, 1, kAnyIndex, "number of the recipe"})                           \
  X(PointView, 6, "point_view", Operator, "Points a display view in another direction",            \
    kViewArgument, ArgumentInfo{"yaw", "deg", 0.01, -180, 180, "from +Y towards +X"},              \
    ArgumentInfo{"pitch", "deg", 0.01, -90, 90, "up positive"},                                    \
    ArgumentInfo{"h_fov", "deg", 0.01, 0, 360, "horizontal field of view; 0 keeps it"})            \
  X(MixSources, 7, "mix_sources", Operator, "Changes a camera's weight in a display view",         \
    kViewArgument, kSourceArgument,                                                                \
    ArgumentInfo{"weight", "", 0.001, 0.001, 1000, "weight where several cameras overlap"})        \
  X(Trigger, 8, "trigger", Operator,                                                               \
    "Measures the next frame set as a result, like an edge of the trigger line", kNoArgument)      \
  X(AcknowledgeAlarm, 9, "acknowledge_alarm", Operator, "Acknowledges one alarm or all",           \
    ArgumentInfo{"alarm", "", 1, 0, kAnyIndex, "number of the alarm, from 1; 0: all"})             \
  X(Snapshot, 10, "snapshot", Operator,                                                            \
    "Writes the next picture of a view into the snapshot folder", kViewArgument)                   \
  X(SetProcessActive, 11, "set_process_active", Operator,                                          \
    "Sets whether the process is active, for a recipe with process_active = \"command\"",          \
    ArgumentInfo{"active", "", 1, 0, 1, "1: active"})                                              \
  X(Restart, 12, "restart", Integrator, "Restarts orbwatchd, which reads its files again",         \
    kNoArgument)                                                                                   \
  X(DetectBall, 13, "detect_ball", Integrator,                                                     \
    "Proposes the ball's outline found in a camera's next picture", kCameraArgument)               \
  X(RegisterCamera, 14, "register_camera", Integrator,                                             \
    "Proposes a camera's orientation relative to the first one, from what both see",               \
    kCameraArgument)                                                                               \
  X(CorrectAlignment, 15, "correct_alignment", Integrator,                                         \
    "Proposes an alignment that corrects a camera's drift", kCameraArgument)                       \
  X(AcceptAlignment, 16, "accept_alignment", Integrator,                                           \
    "Puts the proposed alignment of a camera in force, with a restart", kCameraArgument)           \
  X(DiscardAlignment, 17, "discard_alignment", Integrator,                                         \
    "Discards the proposed alignment of a camera", kCameraArgument)                                \
  X(LearnCleanBall, 18, "learn_clean_ball", Operator,                                              \
    "Learns the ball as clean from a camera's next pictures, after cleaning", kCameraArgument)     \
  X(MarkPoint, 19, "mark_point", Integrator,                                                       \
    "Marks the tool's light at these coordinates, machine frame: its place in a camera's picture " \
    "becomes a point for place_camera, until the next restart",                                    \
    kCameraArgument, coordinate_argument("x", "to the right"),                                     \
    coordinate_argument("y", "forward"), coordinate_argument("z", "up"))                           \
  X(ForgetPoints, 20, "forget_points", Integrator, "Discards the points marked for a camera",      \
    kCameraArgument)                                                                               \
  X(PlaceCamera, 21, "place_camera", Integrator,                                                   \
    "Proposes a camera's position, from its marked points and the site's tags", kCameraArgument)   \
  X(MoveOutline, 22, "move_outline", Integrator,                                                   \
    "Proposes this centre of the ball's outline in a camera's picture", kCameraArgument,           \
    pixel_argument("u", "to the right, pixel centres at integers"), pixel_argument("v", "down"))   \
  X(ShapeOutline, 23, "shape_outline", Integrator,                                                 \
    "Proposes these semi-axes of the ball's outline in a camera's picture", kCameraArgument,       \
    radius_argument("rx", "the first semi-axis"),                                                  \
    radius_argument("ry", "the second semi-axis, perpendicular to the first"),                     \
    ArgumentInfo{"angle", "deg", 0.01, -180, 180,                                                  \
                 "angle of the first semi-axis, from u towards v"})                                \
  X(TurnCamera, 24, "turn_camera", Integrator,                                                     \
    "Proposes this rotation of a camera's directions about the ball, in the machine frame",        \
    kCameraArgument, ArgumentInfo{"yaw", "deg", 0.001, -180, 180, "about Z, from +Y towards +X"},  \
    ArgumentInfo{"pitch", "deg", 0.001, -90, 90, "about X, up positive"},                          \
    ArgumentInfo{"roll", "deg", 0.001, -180, 180, "about Y, positive lowers the right side"})      \
  X(UndoAlignment, 25, "undo_alignment", Integrator,                                               \
    "Undoes the last change of a camera's proposed alignment", kCameraArgument)                    \
  X(RevertAlignment, 26, "revert_alignment", Integrator,                                           \
    "Puts a camera's previous alignment in force, with a restart; repeated, it restores the "      \
    "present one",                                                                                 \
    kCameraArgument)                                                                               \
  X(PickPixel, 27, "pick_pixel", Integrator,                                                       \
    "Picks a pixel of a camera that shows a known point; the next mark_point states its "          \
    "coordinates, instead of the tool's light",                                                    \
    kCameraArgument, pixel_argument("u", "to the right, pixel centres at integers"),               \
    pixel_argument("v", "down"))                                                                   \
  X(SetColourMap, 28, "set_colour_map", Operator,                                                  \
    "Changes the colour map of a one-channel camera in a view; measurements are unaffected",       \
    kViewArgument, kSourceArgument,                                                                \
    ArgumentInfo{"colour_map", "", 1, 0, 4, "0 grey, 1 inferno, 2 turbo, 3 hot, 4 viridis"})       \
  X(SetColourRange, 29, "set_colour_range", Operator,                                              \
    "Sets the values of the first and last colour of a one-channel camera in a view; "             \
    "measurements are unaffected",                                                                 \
    kViewArgument, kSourceArgument,                                                                \
    ArgumentInfo{"first", "", 0.1, kLeastValue, kMostValue - 1,                                    \
                 "value of the first colour: degC of a radiometric camera, else percent of full "  \
                 "scale; below last",                                                              \
                 true},                                                                            \
    ArgumentInfo{"last", "", 0.1, kLeastValue + 1, kMostValue, "value of the last colour"})        \
  X(ForgetPoint, 30, "forget_point", Integrator,                                                   \
    "Discards the point marked for a camera at these coordinates, machine frame", kCameraArgument, \
    coordinate_argument("x", "to the right"), coordinate_argument("y", "forward"),                 \
    coordinate_argument("z", "up"))                                                                \
  X(CancelAlignment, 31, "cancel_alignment", Integrator,                                           \
    "Cancels the alignment or point being computed for a camera; nothing of it is kept",           \
    kCameraArgument)                                                                               \
  X(RecordEvent, 32, "record_event", Operator,                                                     \
    "Records an event with pictures from before and after this moment", kNoArgument)

enum class CommandCode : std::uint16_t {
#define ORBWATCH_CODE(code, number, ...) code = number,
  ORBWATCH_COMMANDS(ORBWATCH_CODE)
#undef ORBWATCH_CODE
};

/// The facts about one command, for every interface that offers it.
struct CommandInfo {
  CommandCode code;
  std::string_view name;
  Role role;
  std::string_view description;
  std::array<ArgumentInfo, kMaxArguments> arguments{};

  constexpr std::size_t argument_count() const {
    std::size_t count = 0;
    while (count < kMaxArguments && !arguments[count].name.empty()) ++count;
    return count;
  }
};

inline constexpr std::array kCommands{
#define ORBWATCH_INFO(code, number, name, role, description, ...) \
  CommandInfo{CommandCode::code, name, Role::role, description, {__VA_ARGS__}},
    ORBWATCH_COMMANDS(ORBWATCH_INFO)
#undef ORBWATCH_INFO
};

/// A command with its arguments, each in the argument's unit.
struct Command {
  CommandCode code = CommandCode::SelectView;
  std::array<double, kMaxArguments> arguments{};
  Giver giver{};

  /// An argument of scale 1, after check().
  std::size_t integer(std::size_t argument) const {
    return static_cast<std::size_t>(arguments[argument]);
  }
};

/// The answer to a command; the numbers go to the PLC.
enum class CommandResult : std::uint16_t {
  Done = 0,
  UnknownCommand = 1,
  ArgumentOutOfRange = 2,
  Busy = 3,         ///< not possible at present; may be repeated
  NotPossible = 4,  ///< not possible with this configuration
  Interrupted = 5,  ///< the process ended before the answer: the command may be executed, in part,
                    ///< or not at all
  NotCarriedOut = 6,  ///< it may have been executed before, or could not be recorded
};

/// The operator's text; empty for a number that is not a result.
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
    case CommandResult::Interrupted:
      return "interrupted by a restart: it may be carried out or not";
    case CommandResult::NotCarriedOut:
      return "not carried out: it may have been before a restart, or could not be recorded";
  }
  return {};
}

/// The facts about a code or a name; nullptr: unknown command. Reentrant.
const CommandInfo* find_command(CommandCode code);
const CommandInfo* find_command(std::string_view name);

/// Checks what does not depend on the configuration: the command is known, its arguments are in
/// range, and those of scale 1 are integers. Done: it may be executed. Reentrant.
CommandResult check(const Command& command);

/// The allowed values: "-180 to 180 deg", "a whole number, 0 to 1". Reentrant.
std::string range_text(const ArgumentInfo& argument);

/// Reason of a refusal by check(), in one line: "yaw is 200; it must be -180 to 180 deg". Empty:
/// not refused. Reentrant.
std::string refusal_text(const Command& command);

/// Executes a command after check(); called by sinks on their own threads. Thread-safe, does not
/// wait.
using CommandHandler = std::function<CommandResult(const Command&)>;

}  // namespace orbwatch::app
