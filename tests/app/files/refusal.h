#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// A file with a fault, and what the message on it must contain.
struct Refusal {
  std::string name;
  std::string text;
  std::vector<std::string> says;
};

/// That the message is one line with all of that in it.
inline void expect_said(const Refusal& refusal, const Error& error) {
  EXPECT_EQ(error.message.find('\n'), std::string::npos) << "one line: " << error.message;
  for (const auto& part : refusal.says) {
    EXPECT_NE(error.message.find(part), std::string::npos) << error.message << "\nlacks: " << part;
  }
}

}  // namespace orbwatch::app
