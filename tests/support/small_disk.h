// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>

#include "tests/support/require.h"

namespace orbwatch::tests {

/// Runs a part of a test in a process of its own, whose limits and mounts it may change.
inline void expect_in_a_process(const std::function<void()>& act) {
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      act();
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
    std::fflush(nullptr);
    ::_exit(testing::Test::HasFailure() ? 1 : 0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0) << "see above";
}

/// Mounts a file system of that size in this process' own mount namespace: "size=64k".
inline void mount_small_disk(const std::filesystem::path& folder, const char* size) {
  require(::unshare(CLONE_NEWNS) == 0);
  require(::mount("", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0);
  require(::mount("small", folder.c_str(), "tmpfs", 0, size) == 0);
}

}  // namespace orbwatch::tests
