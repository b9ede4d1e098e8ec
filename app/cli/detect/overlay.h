// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::app::cli {

/// Writes `picture`, RGB or the luminance of any other format, as 8 bit colour with the outline and
/// its centre drawn into it; 16 bit from the darkest sample to the brightest. Errors: those of
/// write_picture.
Result<> write_overlay(const std::filesystem::path& path, const Picture& picture,
                       const optics::Outline& outline);

}  // namespace orbwatch::app::cli
