// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "app/files/resolve.h"

namespace orbwatch::app::daemon {

/// Folder of the shipped files.
inline const std::filesystem::path kShippedFolder =
    std::filesystem::path(ORBWATCH_SOURCE_DIR) / "platform/config";

/// The demonstration, which each test modifies.
inline files::Resolved demo() {
  auto site = files::resolve(kShippedFolder / "demo.toml");
  EXPECT_TRUE(site) << site.error().message;
  return site.value_or(files::Resolved{});
}

/// Its camera that measures.
inline constexpr std::size_t kThermalCamera = 1;

inline pipeline::Recipe& first(files::Resolved& site) { return site.recipes.front(); }

}  // namespace orbwatch::app::daemon
