// SPDX-License-Identifier: Apache-2.0
#include "app/cli/secret_prompt.h"

#include <termios.h>
#include <unistd.h>

#include <iostream>

namespace orbwatch::app::cli {
namespace {

/// Terminal without echo that passes Ctrl-C as a character.
class SilentTerminal {
 public:
  SilentTerminal() {
    if (::tcgetattr(STDIN_FILENO, &before_) != 0) return;
    termios silent = before_;
    silent.c_lflag &= ~static_cast<tcflag_t>(ECHO | ISIG);
    is_silent_ = ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent) == 0;
  }
  SilentTerminal(const SilentTerminal&) = delete;
  SilentTerminal& operator=(const SilentTerminal&) = delete;
  ~SilentTerminal() {
    if (is_silent_) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
  }
  bool is_silent() const { return is_silent_; }

 private:
  termios before_{};
  bool is_silent_ = false;
};

Result<std::string> ask(const std::string& what) {
  constexpr char kControlC = '\3';
  std::cerr << what << ": " << std::flush;
  std::string line;
  const bool is_read = static_cast<bool>(std::getline(std::cin, line));
  std::cerr << "\n";
  if (!is_read || line.find(kControlC) != std::string::npos) return fail("cancelled");
  return line;
}

}  // namespace

Result<std::string> ask_secret(const std::string& what) {
  const SilentTerminal terminal;
  if (!terminal.is_silent()) return fail("the terminal cannot be kept from showing what is typed");
  return ask(what);
}

Result<std::string> ask_new_secret(const std::string& what) {
  const SilentTerminal terminal;
  if (!terminal.is_silent()) return fail("the terminal cannot be kept from showing what is typed");
  auto first = ask(what);
  if (!first) return first;
  const auto second = ask("Again");
  if (!second) return second;
  if (*first != *second) return fail("the two are not the same; nothing was changed");
  return first;
}

}  // namespace orbwatch::app::cli
