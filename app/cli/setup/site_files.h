// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/cli/setup/setup.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// The files of a site, by their names in its folder.
inline constexpr const char* kSiteFile = "site.toml";
inline constexpr const char* kRigFile = "rig.toml";
inline constexpr const char* kRecipeFile = "recipe.toml";

/// Error: a folder that has one of these files, unless it may be overwritten.
Result<> check_place(const std::filesystem::path& folder, bool overwrite);

/// Writes a site that shows everything and measures the brightest place in front of the ball, a
/// starting point; and for each camera NAME.png, in which the outline is drawn, and NAME.yaml, its
/// calibration. It is written beside the folder and checked as the daemon does first: a wrong site
/// gets nowhere. Error: what the check refuses; files that cannot be written.
Result<> place_site(const Setup& setup, const std::filesystem::path& folder);

}  // namespace orbwatch::app::cli
