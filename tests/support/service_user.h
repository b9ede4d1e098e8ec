// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grp.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <functional>

/// Users other than root, like a service's. Skips a test that is not root, by name.
#define ORBWATCH_WITHOUT_ROOT_SKIPPED()                                 \
  if (::geteuid() != 0) {                                               \
    GTEST_SKIP() << "skipped, missing: root, to be two users by turns"; \
  }

namespace orbwatch::tests {

/// User ids that no process and no file of this system has.
inline constexpr uid_t kService = 64123;
inline constexpr uid_t kMember = 64124;  ///< a person in the service's group
inline constexpr uid_t kStranger = 64125;

inline void give_to_service(const std::filesystem::path& file) {
  ASSERT_EQ(::chown(file.c_str(), kService, kService), 0) << file;
}

/// Calls `act` in a process of that user with that umask; false also if that process fails
/// otherwise. The user is in the service's group unless it is the stranger.
inline bool as_user(uid_t user, mode_t mask, const std::function<bool()>& act) {
  const pid_t child = ::fork();
  if (child == 0) {
    const gid_t group = user == 0 || user == kStranger ? user : kService;
    ::umask(mask);
    const bool is_user = ::setgroups(0, nullptr) == 0 && ::setresgid(group, group, group) == 0 &&
                         ::setresuid(user, user, user) == 0;
    ::_exit(is_user && act() ? 0 : 1);
  }
  int status = 0;
  return child > 0 && ::waitpid(child, &status, 0) == child && status == 0;
}

inline bool as_service(mode_t mask, const std::function<bool()>& act) {
  return as_user(kService, mask, act);
}

}  // namespace orbwatch::tests
