// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "app/files/text/text_file.h"
#include "proc/image/result.h"
#include "proc/optics/lens.h"

namespace orbwatch::app::files {

/// ROS' names of distortion models.
inline constexpr std::array<std::string_view, 4> kDistortionModels{
    "none", "plumb_bob", "rational_polynomial", "equidistant"};

/// Sets the distortion from its name and its coefficients in OpenCV's order: plumb_bob k1 k2 p1 p2
/// [k3], rational_polynomial k1 k2 p1 p2 [k3] [k4 k5 k6], equidistant k1 k2 k3 k4. Further ones
/// must be 0. A pinhole whose coefficients are all 0 has no distortion. Errors: an unknown name,
/// too few coefficients, another one that is not 0, a number that is not finite.
Result<> set_distortion(optics::Intrinsics& intrinsics, std::string_view model,
                        std::span<const double> coefficients);

/// Reads a calibration by OpenCV's calibration program or ROS' camera_calibration, which share
/// their keys. OpenCV's does not name the distortion: it follows from fisheye_model and the number
/// of coefficients. Surplus numbers beyond rows and cols are accepted. Errors: one line with the
/// file, and with the wrong key or line; also everything that optics::Lens refuses.
Result<optics::Intrinsics> read_calibration(const std::filesystem::path& file, TextFiles& files);

/// Parses text in place of a file named `name`.
Result<optics::Intrinsics> parse_calibration(const std::string& text, const std::string& name);

enum class CalibrationFormat { OpenCv, Ros };

/// Calibration as YAML, every number with all its digits. `name` is the camera's, for ROS. Errors:
/// intrinsics that optics::Lens refuses, a name that is not plain.
Result<std::string> calibration_text(const optics::Intrinsics& intrinsics, const std::string& name,
                                     CalibrationFormat format);

/// Writes it to a file, whole or not at all. Errors: as calibration_text and write_file.
Result<> write_calibration(const std::filesystem::path& file, const optics::Intrinsics& intrinsics,
                           const std::string& name, CalibrationFormat format);

}  // namespace orbwatch::app::files
