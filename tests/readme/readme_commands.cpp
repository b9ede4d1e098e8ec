// SPDX-License-Identifier: Apache-2.0
#include "tests/readme/readme_commands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace orbwatch::tests {
namespace {

constexpr const char* kFence = "```";

/// Normalises a line: single spaces, no comment, no space at the ends.
std::string tidy(const std::string& line) {
  std::string text = std::regex_replace(line, std::regex("(^|\\s)#.*"), "");
  text = std::regex_replace(text, std::regex("\\s+"), " ");
  return std::regex_replace(text, std::regex("^ | $"), "");
}

bool looks_like_a_command(const std::string& line) {
  static const std::regex kCommand(
      "(sudo )?(orbwatchd?|apt|systemctl|journalctl|cmake|ctest|git|\\./[a-z]\\S*)( .*)?");
  return std::regex_match(line, kCommand);
}

class Page {
 public:
  explicit Page(std::string name) : name_(std::move(name)) {}

  void add_line(const std::string& line) {
    ++number_;
    if (line.starts_with(kFence)) {
      is_block_ = !is_block_;
      const std::string language = line.substr(3);
      is_shell_ = is_block_ && (language == "sh" || language == "bash");
    } else if (is_block_) {
      add_block_line(tidy(line));
    } else {
      sentences_ += line + "\n";
      line_starts_.push_back({sentences_.size(), number_});
    }
  }

  std::vector<ReadmeCommand> commands() && {
    static const std::regex kCode("`((sudo )?orbwatchd? [^`]+)`");
    for (std::sregex_iterator it(sentences_.begin(), sentences_.end(), kCode), end; it != end;
         ++it) {
      const auto line = std::ranges::upper_bound(
          line_starts_, static_cast<std::size_t>(it->position()), {}, &LineEnd::offset);
      commands_.push_back({place(line->number), tidy((*it)[1]), true});
    }
    return std::move(commands_);
  }

 private:
  /// End of a command within a line of the sentences.
  struct LineEnd {
    std::size_t offset;
    int number;
  };

  std::string place(int number) const { return name_ + ":" + std::to_string(number); }

  void add_block_line(const std::string& line) {
    if (line.empty()) return;
    if (is_shell_) {
      commands_.push_back({place(number_), line, false});
    } else {
      EXPECT_FALSE(looks_like_a_command(line))
          << place(number_) << ": mark the block as " << kFence << "sh: " << line;
    }
  }

  std::string name_;
  std::vector<ReadmeCommand> commands_;
  std::string sentences_;
  std::vector<LineEnd> line_starts_;
  int number_ = 0;
  bool is_block_ = false;
  bool is_shell_ = false;
};

}  // namespace

std::vector<ReadmeCommand> commands_of(const std::string& page) {
  std::ifstream in(std::filesystem::path(ORBWATCH_SOURCE_DIR) / page);
  EXPECT_TRUE(in) << page;
  Page read(page);
  for (std::string line; std::getline(in, line);) read.add_line(line);
  return std::move(read).commands();
}

}  // namespace orbwatch::tests
