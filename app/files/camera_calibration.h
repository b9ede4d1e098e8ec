#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "app/files/text_file.h"
#include "proc/image/result.h"
#include "proc/optics/lens.h"

namespace orbwatch::app {

/// The names of distortion models as ROS writes them; none is ours.
inline constexpr std::array<std::string_view, 4> kDistortionModels{
    "none", "plumb_bob", "rational_polynomial", "equidistant"};

/// Sets the distortion from its name and its coefficients in OpenCV's order: plumb_bob k1 k2 p1 p2
/// [k3], rational_polynomial k1 k2 p1 p2 [k3] [k4 k5 k6], equidistant k1 k2 k3 k4. More of them are
/// 0. A pinhole whose coefficients are all 0 has none. Errors: an unknown name, too few
/// coefficients, another one that is not 0, a number that is not finite.
Result<> set_distortion(optics::Intrinsics& intrinsics, std::string_view model,
                        std::span<const double> coefficients);

/// Reads a calibration as OpenCV's calibration program or ROS' camera_calibration writes it; they
/// have their keys in common. OpenCV's has no name of the distortion: it follows from
/// fisheye_model and from how many coefficients there are. Their rows and cols need not fit, if
/// there are more than these say. Errors: one line with the file, and with
/// the key or line that is wrong; also what optics::Lens refuses.
Result<optics::Intrinsics> read_calibration(const std::filesystem::path& file, TextFiles& files);

/// The same for text that stands in for a file named `name`.
Result<optics::Intrinsics> parse_calibration(const std::string& text, const std::string& name);

enum class CalibrationFormat { OpenCv, Ros };

/// The calibration as YAML, every number with all its digits. `name`: of the camera, for ROS.
/// Errors: intrinsics that optics::Lens refuses, a name that is not plain.
Result<std::string> calibration_text(const optics::Intrinsics& intrinsics, const std::string& name,
                                     CalibrationFormat format);

/// Writes it to a file, whole or not at all. Errors: as calibration_text and write_file.
Result<> write_calibration(const std::filesystem::path& file, const optics::Intrinsics& intrinsics,
                           const std::string& name, CalibrationFormat format);

}  // namespace orbwatch::app
