// SPDX-License-Identifier: Apache-2.0
#include "app/cli/progress.h"

#include <sys/ioctl.h>

#include <algorithm>
#include <utility>

namespace orbwatch::app::cli {
namespace {

constexpr std::chrono::milliseconds kPeriod{100};
constexpr std::size_t kUsualColumns = 80;

/// Columns that a line may use: a line that fills the last column could wrap, and would not be
/// rewritten.
std::size_t usable_columns(int terminal) {
  winsize size{};
  const bool is_known = ::ioctl(terminal, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return (is_known ? size.ws_col : kUsualColumns) - 1;
}

/// Replaces control characters: file names may contain them, and a terminal would obey them.
void disarm(std::string& line) {
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
}

}  // namespace

Progress::Progress(int output) : output_(output), is_terminal_(::isatty(output) != 0) {}

void Progress::begin(const std::string& step) {
  if (!is_terminal_) return;
  step_ = step;
  shown_ = Clock::now();
  write(step + " ...");
}

void Progress::count(const std::string& step, std::size_t done, std::size_t of,
                     const std::string& unit) {
  if (!is_terminal_) return;
  const auto now = Clock::now();
  if (step == step_ && now - shown_ < kPeriod) return;
  step_ = step;
  shown_ = now;
  write(step + ": " + std::to_string(done) + " of " + std::to_string(of) + " " + unit);
}

void Progress::erase() {
  if (written_ == 0) return;
  write("");
  step_.clear();
}

void Progress::write(std::string line) {
  disarm(line);
  line.resize(std::min(line.size(), usable_columns(output_)));
  const std::size_t columns = line.size();
  if (written_ > columns) line.append(written_ - columns, ' ');
  line.insert(line.begin(), '\r');
  if (columns == 0) line += '\r';
  written_ = columns;
  // A failed write is ignored: the terminal is gone, and nothing reads the line.
  static_cast<void>(::write(output_, line.data(), line.size()) < 0);
}

}  // namespace orbwatch::app::cli
