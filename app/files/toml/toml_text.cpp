// SPDX-License-Identifier: Apache-2.0
#include "app/files/toml/toml_text.h"

#include <cstdio>

namespace orbwatch::app::files {

std::string toml_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value == 0 ? 0 : value);  // avoids -0
  return text;
}

std::string toml_list(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + toml_number(value);
  return text + "]";
}

std::string toml_list(std::initializer_list<double> values) {
  return toml_list(std::span(values.begin(), values.size()));
}

std::string toml_vector(const optics::Vec3& v) { return toml_list({v.x, v.y, v.z}); }

std::string toml_matrix(const optics::Mat3& m) {
  std::string text = "[\n";
  for (const optics::Vec3& row : {m.row0, m.row1, m.row2}) {
    text +=
        "  " + toml_number(row.x) + ", " + toml_number(row.y) + ", " + toml_number(row.z) + ",\n";
  }
  return text + "]";
}

std::string toml_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') quoted += '\\';
    if (code >= 0x20 && code != 0x7F) {
      quoted += c;
    } else {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04X", code);
      quoted += escape;
    }
  }
  return quoted + "\"";
}

std::string toml_line(const std::string& key, const std::string& value) {
  return key + " = " + value + "\n";
}

std::vector<TomlValue> toml_values(const optics::Outline& outline) {
  return {{"centre", toml_list({outline.centre.u, outline.centre.v})},
          {"radii", toml_list({outline.rx, outline.ry})},
          {"angle", toml_number(outline.angle)}};
}

std::vector<TomlValue> toml_values(const optics::Pose& pose) {
  return {{"position", toml_vector(pose.position)}, {"rotation", toml_matrix(pose.rotation)}};
}

std::vector<TomlValue> toml_values(const optics::Intrinsics& lens) {
  return {{"fx", toml_number(lens.fx)},
          {"fy", toml_number(lens.fy)},
          {"cx", toml_number(lens.cx)},
          {"cy", toml_number(lens.cy)}};
}

std::string toml_lines(const std::vector<TomlValue>& values) {
  std::string lines;
  for (const auto& [key, text] : values) lines += toml_line(key, text);
  return lines;
}

}  // namespace orbwatch::app::files
