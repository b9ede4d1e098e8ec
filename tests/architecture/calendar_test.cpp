// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

/// With a time_t of 32 bit, as on armhf of Debian 12, these functions turn dates beyond January
/// 2038 into 1901 or 1969. hal/calendar_time.h counts in 64 bit everywhere.
namespace orbwatch::tests {
namespace {

namespace fs = std::filesystem;

TEST(Calendar, NoDateIsCountedInTimeT) {
  static const std::regex kCall(
      R"(\b(timegm|mktime|gmtime|gmtime_r|localtime|localtime_r|to_time_t|ASN1_TIME_set)\s*\()");
  const fs::path root = ORBWATCH_SOURCE_DIR;
  for (const char* top : {"proc", "hal", "app"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream in(entry.path());
      int number = 0;
      for (std::string line; std::getline(in, line);) {
        ++number;
        line.resize(std::min(line.find("//"), line.size()));
        EXPECT_FALSE(std::regex_search(line, kCall))
            << fs::relative(entry.path(), root).string() << ':' << number << ": " << line;
      }
    }
  }
}

}  // namespace
}  // namespace orbwatch::tests
