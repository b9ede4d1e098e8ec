// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::tests {

/// A terminal of `columns` columns; the test acts as its user.
class PseudoTerminal {
 public:
  explicit PseudoTerminal(unsigned short columns = 80) {
    winsize size{24, columns, 0, 0};
    int user = -1, program = -1;
    EXPECT_EQ(openpty(&user, &program, nullptr, nullptr, &size), 0);
    user_ = hal::FileDescriptor(user);
    program_ = hal::FileDescriptor(program);
  }

  /// File descriptor of the program's side.
  int program_side() const { return program_.get(); }

  /// Closes the program's side, and reads until no other process has it open.
  std::string read_to_end() {
    program_ = hal::FileDescriptor();
    std::string text;
    char bytes[4096];
    for (ssize_t count = 0; (count = ::read(user_.get(), bytes, sizeof bytes)) > 0;) {
      text.append(bytes, static_cast<std::size_t>(count));
    }
    return text;
  }

 private:
  hal::FileDescriptor user_, program_;
};

/// Successive contents of a terminal's last line, where a program rewrites it with carriage
/// returns, or erases it from there on (CSI K); without trailing spaces.
inline std::vector<std::string> rewritten_lines(const std::string& text) {
  std::vector<std::string> lines(1);
  std::string shown;
  std::size_t column = 0;
  const auto look = [&] {
    const std::string line = shown.substr(0, shown.find_last_not_of(' ') + 1);
    if (line != lines.back()) lines.push_back(line);
  };
  constexpr std::string_view kErase = "\x1b[K";
  for (std::size_t n = 0; n < text.size(); ++n) {
    const char c = text[n];
    if (text.compare(n, kErase.size(), kErase) == 0) {
      shown.resize(std::min(column, shown.size()));
      n += kErase.size() - 1;
    } else if (c == '\r') {
      look();
      column = 0;
    } else if (c == '\n') {
      shown.clear();
    } else {
      if (shown.size() <= column) shown.resize(column + 1, ' ');
      shown[column++] = c;
    }
  }
  look();
  return lines;
}

}  // namespace orbwatch::tests
