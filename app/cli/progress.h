// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace orbwatch::app::cli {

/// Shows the progress of a command to the user: one line on a terminal, rewritten in place and
/// erased at this object's end. Writes nothing if the output is not a terminal. Thread-bound.
class Progress {
 public:
  explicit Progress(int output = STDERR_FILENO);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { erase(); }

  /// Shows the step that begins, such as "matching edges".
  void begin(const std::string& step);

  /// Shows the progress of a step: "watching: 12 of 300 pictures". Updated ten times a second at
  /// most, and when the step changes.
  void count(const std::string& step, std::size_t done, std::size_t of, const std::string& unit);

  /// Makes room for other text on the terminal; the next call writes the line again.
  void erase();

 private:
  using Clock = std::chrono::steady_clock;

  void write(std::string line);

  int output_;
  bool is_terminal_;
  std::size_t written_ = 0;  ///< columns of the visible line
  std::string step_;
  Clock::time_point shown_{};
};

}  // namespace orbwatch::app::cli
