// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/cli_result.h"
#include "hal/replay/picture_decoder.h"

namespace orbwatch::app::cli {

/// NAME=PATH of a command line, and the pictures there.
struct NamedPictures {
  std::string name;
  std::vector<hal::DecodedPicture> pictures;  ///< at least one, all of the first one's size

  std::vector<Picture> views() const;
};

/// PATH is a picture, or a folder: its first kMostPictures pictures in natural order. Error: no
/// NAME=PATH, no picture there, one that cannot be read or is of another size.
CliResult<NamedPictures> read_named_pictures(const std::string& word);

inline constexpr std::size_t kMostPictures = 120;

}  // namespace orbwatch::app::cli
