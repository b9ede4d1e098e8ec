// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace orbwatch::app::files {

/// The text with the first `what` replaced by `with`.
inline std::string replaced(const std::string& what, const std::string& with, std::string text) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

}  // namespace orbwatch::app::files
