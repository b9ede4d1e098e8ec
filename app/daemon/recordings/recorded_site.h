// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "app/files/resolve.h"
#include "hal/mcap/reader.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// Texts in place of recorded recipes, by the number of the recipe.
using OtherRecipes = std::map<std::uint16_t, std::string>;

/// The configuration in the attachments of a recording, with the alignments that were in force.
/// Files of this computer are not read. Errors: no configuration in it, or a part of it; that of
/// resolve(); no recipe of a number in `others`.
Result<files::Resolved> recorded_site(const std::filesystem::path& file, hal::mcap::Reader& reader,
                                      const OtherRecipes& others = {});

}  // namespace orbwatch::app::daemon
