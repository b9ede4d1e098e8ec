// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::tests {

/// Mistake of a user.
struct Mistake {
  std::string name;
  std::vector<std::string> arguments;  ///< DIR/ is replaced by the test's folder
  std::vector<std::string> says;       ///< parts of the message
};

/// Runs `orbwatch` like a user: the program, files in, files out.
class CommandLine : public testing::Test {
 protected:
  /// Runs the program; returns its exit code and keeps its output.
  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), ORBWATCH_PROGRAM);
    Subprocess program(arguments, folder.path() / "said");
    const int code = program.wait();
    said = program.output();
    std::filesystem::remove(folder.path() / "said");
    return code;
  }

  /// Checks for one line with the reason, and that no file is left.
  void expect_refused(const std::string& command, const Mistake& mistake) {
    const auto before = folder.files();
    std::vector<std::string> arguments{command};
    for (const std::string& argument : mistake.arguments) {
      const std::size_t at = argument.find("DIR/");
      arguments.push_back(at == std::string::npos
                              ? argument
                              : argument.substr(0, at) + path(argument.substr(at + 4)));
    }
    EXPECT_GT(run(arguments), 0);
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    for (const auto& part : mistake.says) {
      EXPECT_NE(said.find(part), std::string::npos) << said << "lacks: " << part;
    }
    EXPECT_EQ(folder.files(), before) << "left something behind";
  }

  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  std::string write(const std::string& name, const cv::Mat& picture) const {
    EXPECT_TRUE(cv::imwrite(path(name), picture));
    return path(name);
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

  TemporaryFolder folder;
  std::string said;
};

}  // namespace orbwatch::tests
