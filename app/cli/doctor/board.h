// SPDX-License-Identifier: Apache-2.0
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

namespace orbwatch::app::cli::doctor {

/// Resistor of a line from power-on until a program sets it.
enum class Pull : std::uint8_t { Unknown, None, Up, Down };

inline constexpr std::array kPulls{Word{"unknown", Pull::Unknown}, Word{"none", Pull::None},
                                   Word{"up", Pull::Up}, Word{"down", Pull::Down}};

/// Digital lines of a board with equal properties.
struct BoardLines {
  std::vector<std::string> names;  ///< names in the kernel
  double volt = 0;                 ///< voltage of a high level
  Pull pull = Pull::Unknown;
};

/// Camera that the board does not detect by itself.
struct BoardCamera {
  std::string sensor;       ///< model in libcamera
  std::string overlay;      ///< line of the firmware's configuration
  double trigger_volt = 0;  ///< voltage of its trigger input; 0: it has none
};

/// Facts about a board: a file of platform/boards.
struct Board {
  std::string name{};
  std::vector<std::string> models{};  ///< beginnings of the model names that the board reports
  std::string architecture{};         ///< value of uname -m; in the file for all other boards of it
  std::string tried{};                ///< tests that were run on it, and sources of the facts
  std::string processor{};
  std::vector<std::string> camera_drivers{};  ///< kernel drivers for libcamera
  std::string kernel_package{};               ///< Debian kernel package with these drivers
  std::string firmware_file{};                ///< file for the lines of overlays
  std::vector<std::string> firmware_lines{};  ///< lines that precede a camera's overlay there
  double slows_down_at = 0;                   ///< degC; 0: unknown
  std::string battery_clock{};                ///< instructions to fit it, if it needs fitting
  std::string supply{};                       ///< volts and amperes
  std::vector<BoardLines> lines{};
  std::vector<BoardCamera> cameras{};
};

template <class Visitor>
void visit(Visitor& v, BoardLines& lines) {
  v.required("names", lines.names, "The kernel's names");
  v.required("volt", lines.volt, Range::between(0.5, 48), "High level, V");
  v.optional("pull", lines.pull, kPulls, "Resistor from power-on until the line is driven");
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
  v.required("name", board.name, "Board name, for display");
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

/// Reads a board's file. A key `like` names the file, without its extension, that it extends or
/// overrides; that file must not have a `like`. Error: file, line, key and reason.
Result<Board> read_board(const std::filesystem::path& file);

/// The readable files of `folder`. `problems`: a line for each file that cannot be read.
std::vector<Board> read_boards(const std::filesystem::path& folder,
                               std::vector<std::string>& problems);

/// The board that reports the name `model`, by the longest matching beginning; else the one for all
/// of `architecture`. Nullptr: none.
const Board* find_board(const std::vector<Board>& boards, std::string_view model,
                        std::string_view architecture);

/// The group of lines of a board that includes this name; nullptr: unknown.
const BoardLines* find_lines(const Board& board, std::string_view name);

/// The camera whose sensor's name is part of `wanted`; nullptr: unknown.
const BoardCamera* find_camera(const Board& board, std::string_view wanted);

}  // namespace orbwatch::app::cli::doctor
