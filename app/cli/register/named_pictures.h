// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
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

/// The pictures of two cameras. PATH is a picture, or a folder or recording: its first
/// kMostPictures pictures in order; of one recording those of frame sets in which both have one.
/// Errors: no NAME=PATH, no picture there, one that cannot be read or is of another size, no common
/// frame set.
CliResult<std::array<NamedPictures, 2>> read_named_pictures(
    const std::array<std::string, 2>& words);

inline constexpr std::size_t kMostPictures = 120;

}  // namespace orbwatch::app::cli
