#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "proc/image/result.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::doctor {

/// The resistor of a line from power-on until somebody sets it.
enum class Pull : std::uint8_t { Unknown, None, Up, Down };

inline constexpr std::array kPulls{Word{"unknown", Pull::Unknown}, Word{"none", Pull::None},
                                   Word{"up", Pull::Up}, Word{"down", Pull::Down}};

/// Digital lines of a board that are alike.
struct BoardLines {
  std::vector<std::string> names;  ///< as the kernel names them
  double volt = 0;                 ///< of a high level
  Pull pull = Pull::Unknown;
};

/// A camera that the board does not find by itself.
struct BoardCamera {
  std::string sensor;       ///< libcamera's model
  std::string overlay;      ///< line of the firmware's configuration
  double trigger_volt = 0;  ///< of its trigger input; 0: it has none
};

/// What is known of a board: a file of platform/boards.
struct Board {
  std::string name{};
  std::vector<std::string> models{};  ///< beginnings of what the board calls itself
  std::string architecture{};         ///< as uname -m; of a file for all other boards of it
  std::string tried{};                ///< what was run on it, and where the facts are from
  std::string processor{};
  std::vector<std::string> camera_drivers{};  ///< of the kernel, for libcamera
  std::string kernel_package{};               ///< of Debian's kind, with these drivers
  std::string firmware_file{};                ///< where the lines of overlays are written
  std::vector<std::string> firmware_lines{};  ///< in front of a camera's overlay there
  double slows_down_at = 0;                   ///< degC; 0: unknown
  std::string battery_clock{};                ///< how it is fitted, if it needs fitting
  std::string supply{};                       ///< volts and amperes
  std::vector<BoardLines> lines{};
  std::vector<BoardCamera> cameras{};
};

template <class Visitor>
void visit(Visitor& v, BoardLines& lines) {
  v.required("names", lines.names, "The kernel's names");
  v.required("volt", lines.volt, Range::between(0.5, 48), "High level, V");
  v.optional("pull", lines.pull, kPulls, "Resistor from power-on until somebody sets it");
}

template <class Visitor>
void visit(Visitor& v, BoardCamera& camera) {
  v.required("sensor", camera.sensor, "libcamera's model");
  v.required("overlay", camera.overlay, "Line of the firmware's configuration");
  v.optional("trigger_volt", camera.trigger_volt, Range::between(0.5, 48),
             "High level of its trigger input, V");
}

template <class Visitor>
void visit(Visitor& v, Board& board) {
  v.required("name", board.name, "For people");
  v.optional("models", board.models, "Beginnings of what the board calls itself");
  v.optional("architecture", board.architecture, "Of a file for all other boards, as uname -m");
  v.required("tried", board.tried, "What was run on it, and where the facts are from");
  v.optional("processor", board.processor, "Cores and their kind");
  v.optional("camera_drivers", board.camera_drivers, "Kernel modules for libcamera");
  v.optional("kernel_package", board.kernel_package, "With these drivers");
  v.optional("firmware_file", board.firmware_file, "Where the lines of overlays are written");
  v.optional("firmware_lines", board.firmware_lines, "In front of a camera's overlay there");
  v.optional("slows_down_at", board.slows_down_at, Range::between(30, 150), "degC");
  v.optional("battery_clock", board.battery_clock, "How it is fitted, if it needs fitting");
  v.optional("supply", board.supply, "Volts and amperes");
  v.tables("line", board.lines, 0, 64, "Digital lines");
  v.tables("camera", board.cameras, 0, 64, "Cameras that are not found by themselves");
}

/// Reads a board's file. A key `like` names the file, without its ending, that it adds to or
/// differs from; that one names none. Error: file, line, key and what is wrong.
Result<Board> read_board(const std::filesystem::path& file);

/// The files of `folder` that can be read. `problems`: a line for each that cannot.
std::vector<Board> read_boards(const std::filesystem::path& folder,
                               std::vector<std::string>& problems);

/// The board whose name of itself is `model`, by the longest beginning that fits; else the one for
/// all of `architecture`. Nullptr: none.
const Board* find_board(const std::vector<Board>& boards, std::string_view model,
                        std::string_view architecture);

/// The lines of a board that include one of this name; nullptr: unknown.
const BoardLines* find_lines(const Board& board, std::string_view name);

/// The camera whose sensor's name is in `wanted`; nullptr: unknown.
const BoardCamera* find_camera(const Board& board, std::string_view wanted);

}  // namespace orbwatch::app::doctor
