// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "app/cli/setup/setup.h"

namespace orbwatch::app::cli {

/// Found and missing facts of a site, for people, and the command that runs it: as a trial of the
/// installed service if there is its configuration, files::site_file(). Both reentrant while
/// nothing changes the environment.
std::string setup_text(const Setup& setup, const std::filesystem::path& site);

/// The same as one JSON document.
std::string setup_json(const Setup& setup, const std::filesystem::path& site);

}  // namespace orbwatch::app::cli
