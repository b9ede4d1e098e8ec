// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string>

namespace orbwatch::app::files {

/// Keeps a message that quotes a file on one line: control characters become question marks.
inline std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
  return text;
}

/// File that another file names, and the line of the key that names it.
struct NamedFile {
  std::filesystem::path path;
  int line = 0;
};

/// Reason why a file is refused. Only the first reason is kept, since later ones often follow from
/// it; an unknown key replaces it, since a misspelt key is also a missing one.
struct Finding {
  std::string file;
  std::filesystem::path folder;  ///< base of relative paths in the file
  std::optional<std::string> message{};
  bool unknown_key = false;

  void refuse(int line, const std::string& text) {
    if (!message) message = one_line(file + ":" + std::to_string(line) + ": " + text);
  }
  void refuse(int line, const std::string& key, const std::string& text) {
    refuse(line, key + ": " + text);
  }
  void refuse_unknown(int line, const std::string& key, const std::string& text) {
    if (unknown_key) return;
    message.reset();
    unknown_key = true;
    refuse(line, key, text);
  }
};

}  // namespace orbwatch::app::files
