#pragma once

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace orbwatch::app {

/// What a command is doing, for people who wait: one line on a terminal, rewritten in place and
/// erased at this object's end. On anything but a terminal it writes nothing. Thread-bound.
class Progress {
 public:
  explicit Progress(int output = STDERR_FILENO);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { erase(); }

  /// The step that begins: "matching edges".
  void begin(const std::string& step);

  /// How far a step is: "watching: 12 of 300 pictures". Shown ten times a second at most, and when
  /// the step changes.
  void count(const std::string& step, std::size_t done, std::size_t of, const std::string& unit);

  /// Makes room for other text on the terminal; the next call writes anew.
  void erase();

 private:
  using Clock = std::chrono::steady_clock;

  void write(std::string line);

  int output_;
  bool is_terminal_;
  std::size_t written_ = 0;  ///< columns of the line that is shown
  std::string step_;
  Clock::time_point shown_{};
};

}  // namespace orbwatch::app
