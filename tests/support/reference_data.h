// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace orbwatch::tests {

/// The folder of reference pictures beside the project, which a checkout may lack.
inline std::filesystem::path reference_data() {
  return std::filesystem::path(ORBWATCH_SOURCE_DIR) / ".." / "shared" / "data";
}

/// True in CI's acceptance mode, where a test that cannot run has failed.
inline bool acceptance_mode() { return std::getenv("ORBWATCH_ACCEPTANCE") != nullptr; }

}  // namespace orbwatch::tests

/// Ends the test when `path` is missing: skipped with the reason, or failed in acceptance mode.
#define ORBWATCH_REQUIRE_FILE(path)                                            \
  do {                                                                         \
    if (!std::filesystem::exists(path)) {                                      \
      if (orbwatch::tests::acceptance_mode()) FAIL() << "missing: " << (path); \
      GTEST_SKIP() << "skipped, missing: " << (path);                          \
    }                                                                          \
  } while (false)
