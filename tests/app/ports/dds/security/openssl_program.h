// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::tests {

/// OpenSSL's program, independent of our code.
class OpensslProgram {
 public:
  /// Runs it; returns its exit code and keeps its output.
  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), OPENSSL_PROGRAM);
    orbwatch::tests::Subprocess program(arguments, folder_ / "said");
    const int code = program.wait();
    said = program.output();
    return code;
  }

  std::string said;

 private:
  orbwatch::tests::TemporaryFolder folder_;
};

inline std::string text_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

}  // namespace orbwatch::app::tests
