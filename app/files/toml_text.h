// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>

#include "proc/optics/ball_projection.h"
#include "proc/optics/outline.h"
#include "proc/optics/vec.h"

/// Values in TOML's notation, numbers with 10 digits.
namespace orbwatch::app {

std::string toml_number(double value);
std::string toml_list(std::initializer_list<double> values);
std::string toml_vector(const optics::Vec3& vector);
/// Matrix by rows, on lines of their own.
std::string toml_matrix(const optics::Mat3& matrix);
/// Quoted string; control characters and quotes are escaped.
std::string toml_string(const std::string& text);

/// Line with a key and its value.
std::string toml_line(const char* key, const std::string& value);
/// Values of a limb, and of a pose, in the notation of a rig and a calibration.
std::string toml_outline(const optics::Outline& outline);
std::string toml_pose(const optics::Pose& pose);

}  // namespace orbwatch::app
