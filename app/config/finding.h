#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string>

namespace orbwatch::app {

/// A message that quotes a file stays one line: control characters become question marks.
inline std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
  return text;
}

/// What is wrong with a file. Only the first finding counts, since later ones often follow from it;
/// but a key that nobody knows goes before, since a misspelt key is also a missing one.
struct Finding {
  std::string file;
  std::filesystem::path folder;  ///< relative paths in the file count from here
  std::optional<std::string> message;
  bool unknown_key = false;

  void note(int line, const std::string& text) {
    if (!message) message = one_line(file + ":" + std::to_string(line) + ": " + text);
  }
  void note(int line, const std::string& key, const std::string& text) {
    note(line, key + ": " + text);
  }
  void note_unknown(int line, const std::string& key, const std::string& text) {
    if (unknown_key) return;
    message.reset();
    unknown_key = true;
    note(line, key, text);
  }
};

}  // namespace orbwatch::app
