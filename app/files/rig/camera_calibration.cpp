// SPDX-License-Identifier: Apache-2.0
#include "app/files/rig/camera_calibration.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <vector>

#include "app/files/plain_names.h"
#include "app/files/toml/finding.h"
#include "hal/atomic_file.h"
#include "proc/optics/named_distortion.h"

namespace orbwatch::app::files {
namespace {

using optics::Distortion;
using optics::Intrinsics;

/// Shortest text that reads back as the same number.
std::string text_of(double number) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
  std::string text(buffer, end);
  // A YAML reader would parse "1" as an integer.
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// Defect of a calibration file; converted to an Error within this file.
struct Unusable {
  std::string reason;
};

YAML::Node required(const YAML::Node& file, const char* key) {
  const YAML::Node node = file[key];
  if (!node) throw Unusable{std::string(key) + " is missing"};
  return node;
}

template <class T>
T scalar(const YAML::Node& node, const char* key, const char* kind) {
  try {
    return node.as<T>();
  } catch (const YAML::BadConversion&) {
    throw Unusable{std::string(key) + " must be " + kind};
  }
}

/// Treatment of numbers in a matrix beyond rows x cols: refused, or also read.
enum class Surplus { Refused, Read };

/// Numbers of a matrix {rows, cols, data}.
std::vector<double> matrix(const YAML::Node& file, const char* key, Surplus surplus) {
  const YAML::Node node = required(file, key);
  const YAML::Node data = node.IsMap() ? node["data"] : YAML::Node(YAML::NodeType::Undefined);
  if (!data || !data.IsSequence() || !node["rows"] || !node["cols"]) {
    throw Unusable{std::string(key) + " must be a matrix with rows, cols and data"};
  }
  const auto rows = scalar<std::uint16_t>(node["rows"], key, "a matrix with a number of rows");
  const auto columns = scalar<std::uint16_t>(node["cols"], key, "a matrix with a number of cols");
  const std::size_t expected = std::size_t{rows} * columns;
  if (data.size() < expected || (data.size() > expected && surplus == Surplus::Refused)) {
    throw Unusable{std::string(key) + " has " + std::to_string(data.size()) + " numbers, not " +
                   std::to_string(rows) + "x" + std::to_string(columns)};
  }
  std::vector<double> numbers;
  for (const YAML::Node& item : data) {
    numbers.push_back(scalar<double>(item, key, "a matrix of numbers"));
  }
  return numbers;
}

void set_camera_matrix(Intrinsics& intrinsics, const YAML::Node& file) {
  const std::vector<double> k = matrix(file, "camera_matrix", Surplus::Refused);
  const bool shaped = k.size() == 9 && k[3] == 0 && k[6] == 0 && k[7] == 0 && k[8] == 1;
  if (shaped && k[1] != 0) {
    throw Unusable{"camera_matrix has a skew (" + text_of(k[1]) +
                   "), which must be 0; calibrate again with cv::fisheye::CALIB_FIX_SKEW, which "
                   "ROS' cameracalibrator calls --fisheye-fix-skew"};
  }
  if (!shaped) throw Unusable{"camera_matrix must be [fx, 0, cx, 0, fy, cy, 0, 0, 1]"};
  intrinsics.fx = k[0];
  intrinsics.cx = k[2];
  intrinsics.fy = k[4];
  intrinsics.cy = k[5];
}

std::string distortion_model(const YAML::Node& file, std::size_t coefficients) {
  if (const YAML::Node name = file["distortion_model"]) {
    return scalar<std::string>(name, "distortion_model", "a word");
  }
  const YAML::Node fisheye = file["fisheye_model"];
  if (fisheye && scalar<int>(fisheye, "fisheye_model", "0 or 1") != 0) return "equidistant";
  if (coefficients == 0) return "none";
  return coefficients <= 5 ? "plumb_bob" : "rational_polynomial";
}

Intrinsics intrinsics_of(const YAML::Node& file) {
  if (!file.IsMap()) throw Unusable{"it must be a calibration as OpenCV or ROS write it, in YAML"};
  Intrinsics intrinsics;
  intrinsics.width = scalar<int>(required(file, "image_width"), "image_width", "a whole number");
  intrinsics.height = scalar<int>(required(file, "image_height"), "image_height", "a whole number");
  set_camera_matrix(intrinsics, file);
  // Some versions of ROS' camera_calibration wrote cols: 5 above the 8 numbers of
  // rational_polynomial.
  const std::vector<double> coefficients = matrix(file, "distortion_coefficients", Surplus::Read);
  const auto set =
      set_distortion(intrinsics, distortion_model(file, coefficients.size()), coefficients);
  if (!set) throw Unusable{set.error().message};
  if (const auto lens = optics::Lens::make(intrinsics); !lens) throw Unusable{lens.error().message};
  return intrinsics;
}

/// Text of a matrix in the given format: OpenCV marks the type.
std::string matrix_text(const std::string& key, int columns, const std::vector<double>& numbers,
                        CalibrationFormat format) {
  const bool opencv = format == CalibrationFormat::OpenCv;
  std::string data;
  for (const double number : numbers) data += (data.empty() ? "" : ", ") + text_of(number);
  return key + (opencv ? ": !!opencv-matrix\n" : ":\n") +
         "  rows: " + std::to_string(static_cast<int>(numbers.size()) / columns) +
         "\n  cols: " + std::to_string(columns) + (opencv ? "\n  dt: d" : "") + "\n  data: [" +
         data + "]\n";
}

}  // namespace

Result<> set_distortion(Intrinsics& intrinsics, std::string_view model,
                        std::span<const double> coefficients) {
  // OpenCV and drivers write longer lists than the model has, the rest 0: for other models, thin
  // prisms and a tilted sensor.
  const std::size_t given = coefficients.size();
  std::size_t used = given;
  while (used > 0 && coefficients[used - 1] == 0) --used;
  const auto taken = [&](bool are_enough, std::size_t most, const char* count) -> Result<> {
    if (are_enough && used <= most) return {};
    return fail(std::string(model) + " takes " + count + " coefficients; " + std::to_string(given) +
                " are given" +
                (used > most ? ", and number " + std::to_string(used) + " is not 0" : ""));
  };
  Result<> counted;
  Distortion distortion = used == 0 ? Distortion::None : Distortion::Pinhole;
  if (model == "none") {
    counted = taken(true, 0, "no");
  } else if (model == "plumb_bob") {
    counted = taken(given >= 4, 5, "4 or 5");
  } else if (model == "rational_polynomial") {
    counted = taken(given == 4 || given == 5 || given >= 8, 8, "8");
  } else if (model == "equidistant") {
    distortion = Distortion::Fisheye;
    counted = taken(given >= 4, 4, "4");
  } else {
    std::string known;
    for (const auto name : kDistortionModels)
      known += (known.empty() ? "" : ", ") + std::string(name);
    return fail("the distortion \"" + std::string(model) + "\" is unknown; use one of: " + known);
  }
  if (!counted) return counted;
  if (!std::all_of(coefficients.begin(), coefficients.end(),
                   [](double k) { return std::isfinite(k); })) {
    return fail("the distortion's coefficients must be finite");
  }
  intrinsics.distortion = distortion;
  intrinsics.coefficients = {};
  std::copy_n(coefficients.begin(), used, intrinsics.coefficients.begin());
  return {};
}

Result<Intrinsics> parse_calibration(const std::string& text, const std::string& name) {
  try {
    return intrinsics_of(YAML::Load(text));
  } catch (const Unusable& unusable) {
    return fail(one_line(name + ": " + unusable.reason));
  } catch (const YAML::Exception& error) {
    const std::string line = std::to_string(error.mark.line + 1);
    return fail(one_line(name + ":" + line + ": not valid YAML: " + error.msg));
  }
}

Result<Intrinsics> read_calibration(const std::filesystem::path& file, TextFiles& files) {
  return files.read(file, "a calibration in YAML").and_then([&](const std::string& text) {
    return parse_calibration(text, file.string());
  });
}

Result<std::string> calibration_text(const Intrinsics& intrinsics, const std::string& name,
                                     CalibrationFormat format) {
  if (const auto lens = optics::Lens::make(intrinsics); !lens) return tl::unexpected(lens.error());
  if (!is_plain_name(name)) {
    return fail("a camera cannot be called \"" + name +
                "\" in a calibration; use letters, digits and single _, a letter first");
  }
  const Intrinsics& i = intrinsics;
  const auto [model, used] = optics::named_distortion(i);
  const auto count = static_cast<int>(used);
  const std::vector<double> coefficients(i.coefficients.begin(), i.coefficients.begin() + count);
  const std::string size = "image_width: " + std::to_string(i.width) +
                           "\nimage_height: " + std::to_string(i.height) + "\n";
  const std::string camera_matrix =
      matrix_text("camera_matrix", 3, {i.fx, 0, i.cx, 0, i.fy, i.cy, 0, 0, 1}, format);
  if (format == CalibrationFormat::OpenCv) {
    return "%YAML:1.0\n---\n" + size + camera_matrix +
           "fisheye_model: " + (i.distortion == Distortion::Fisheye ? "1\n" : "0\n") +
           matrix_text("distortion_coefficients", 1, coefficients, format);
  }
  return size + "camera_name: " + name + "\n" + camera_matrix +
         "distortion_model: " + std::string(model) + "\n" +
         matrix_text("distortion_coefficients", count, coefficients, format) +
         matrix_text("rectification_matrix", 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}, format) +
         matrix_text("projection_matrix", 4, {i.fx, 0, i.cx, 0, 0, i.fy, i.cy, 0, 0, 0, 1, 0},
                     format);
}

Result<> write_calibration(const std::filesystem::path& file, const Intrinsics& intrinsics,
                           const std::string& name, CalibrationFormat format) {
  return calibration_text(intrinsics, name, format).and_then([&](const std::string& text) {
    return hal::write_file(file, text, hal::FileAccess::Folder);
  });
}

}  // namespace orbwatch::app::files
