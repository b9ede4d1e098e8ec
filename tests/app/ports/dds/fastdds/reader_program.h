// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <opencv2/core/persistence.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/network_namespace.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::tests {

/// A reader program in a network, and its output so far: JSON, one object per line.
class ReaderProgram {
 public:
  ReaderProgram(const NetworkNamespace& where, const std::vector<std::string>& command) {
    where.run([&] { program_.emplace(command, folder_ / "printed"); });
  }

  Subprocess& program() { return *program_; }

  std::string printed() const { return program_->output(); }

  /// Complete lines that have a member of that name.
  std::vector<std::string> lines_with(const std::string& member) const {
    std::vector<std::string> found;
    std::istringstream text(printed());
    for (std::string line; std::getline(text, line) && !text.eof();) {
      if (line.find('"' + member + "\":") != std::string::npos) found.push_back(line);
    }
    return found;
  }

  std::vector<std::string> samples() const { return lines_with("since_match_ms"); }

  /// Announcement of the matched writer; nullopt: none yet.
  std::optional<std::string> match() const {
    const auto lines = lines_with("matched");
    if (lines.empty()) return std::nullopt;
    return lines.front();
  }

 private:
  TemporaryFolder folder_;
  std::optional<Subprocess> program_;
};

/// Command line of another vendor's reader; `options` are those of fastdds_reader besides the
/// domain.
inline std::vector<std::string> foreign_reader(int domain,
                                               const std::vector<std::string>& options) {
  std::vector<std::string> command{FASTDDS_READER_PROGRAM, "--domain", std::to_string(domain)};
  command.insert(command.end(), options.begin(), options.end());
  return command;
}

/// Parses one printed line; its members are fs["name"].
inline cv::FileStorage parsed(const std::string& line) {
  return {line, cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_JSON};
}

}  // namespace orbwatch::tests
