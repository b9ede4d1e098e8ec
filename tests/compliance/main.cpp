// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/compliance/camera_under_test.h"

/// Usage: camera_compliance SETTINGS.toml [--gtest_...]
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();  // the build lists the tests
  if (argc != 2) {
    std::fputs("Usage: camera_compliance SETTINGS.toml; see tests/compliance/README.md\n", stderr);
    return 2;
  }
  if (const auto loaded = orbwatch::tests::CameraUnderTest::load(argv[1]); !loaded) {
    std::fprintf(stderr, "camera_compliance: %s\n", loaded.error().message.c_str());
    return 2;
  }
  return RUN_ALL_TESTS();
}
