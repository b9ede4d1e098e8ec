// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app::files {

/// File with a fault, and the required contents of its message.
struct Refusal {
  std::string name;
  std::string text;
  std::vector<std::string> says;
};

/// Checks that the message is one line with all of the required parts.
inline void expect_said(const Refusal& refusal, const Error& error) {
  EXPECT_EQ(error.message.find('\n'), std::string::npos) << "one line: " << error.message;
  for (const auto& part : refusal.says) {
    EXPECT_NE(error.message.find(part), std::string::npos) << error.message << "\nlacks: " << part;
  }
}

}  // namespace orbwatch::app::files
