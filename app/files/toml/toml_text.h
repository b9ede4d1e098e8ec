// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/optics/lens.h"
#include "proc/optics/outline.h"
#include "proc/optics/vec.h"

/// Values in TOML's notation, numbers with 10 digits.
namespace orbwatch::app::files {

std::string toml_number(double value);
std::string toml_list(std::span<const double> values);
std::string toml_list(std::initializer_list<double> values);
std::string toml_vector(const optics::Vec3& vector);
/// Matrix by rows, on lines of their own.
std::string toml_matrix(const optics::Mat3& matrix);
/// Quoted string; control characters and quotes are escaped.
std::string toml_string(const std::string& text);

/// Line with a key and its value.
std::string toml_line(const std::string& key, const std::string& value);
/// A key and its value in TOML's notation.
struct TomlValue {
  std::string key;
  std::string text;
};

/// Values of a limb, a pose and a lens without distortion, by the keys of a rig and a calibration.
std::vector<TomlValue> toml_values(const optics::Outline& outline);
std::vector<TomlValue> toml_values(const optics::Pose& pose);
std::vector<TomlValue> toml_values(const optics::Intrinsics& lens);

std::string toml_lines(const std::vector<TomlValue>& values);

}  // namespace orbwatch::app::files
