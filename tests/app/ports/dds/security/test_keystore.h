// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "app/cli/keys/keystore.h"

namespace orbwatch::app::tests {

inline std::chrono::sys_seconds this_second() {
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
}

/// Request for keys like those of `orbwatch dds-keys`, for the domains of DdsNetwork and some more.
inline cli::KeystoreRequest keystore_request(const std::filesystem::path& folder) {
  return {.folder = folder,
          .domains = {1, 9},
          .appliance = cli::appliance_access("orbwatch"),
          .subscriber = cli::controller_access("orbwatch"),
          .bulk_topics = cli::bulk_topics("orbwatch")};
}

/// Makes the keys; returns the folder.
inline std::filesystem::path make_keystore(const cli::KeystoreRequest& request,
                                           std::chrono::sys_seconds now = this_second()) {
  const auto made = cli::make_keys(request, now);
  EXPECT_TRUE(made) << made.error().message;
  return request.folder;
}

}  // namespace orbwatch::app::tests
