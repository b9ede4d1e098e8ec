// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::app {

/// A picture that belongs to one alignment of a camera: WHAT-CAMERA-NUMBER.png in `folder`, where
/// the number is of the outline. Reentrant.
std::filesystem::path kept_file(const std::filesystem::path& folder, const std::string& what,
                                const std::string& camera, const optics::Outline& outline);

/// Writes it, grey of 8 or 16 bit, and removes those of other alignments of the camera. Reentrant.
/// Error: as write_picture().
Result<> keep_file(const std::filesystem::path& kept, const cv::Mat& pixels);

}  // namespace orbwatch::app
