// SPDX-License-Identifier: Apache-2.0
#include "app/files/rig/camera_calibration.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <random>

#include "tests/app/files/refusal.h"
#include "tests/app/files/replaced.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::files {
namespace {

using optics::Distortion;
using optics::Intrinsics;

std::vector<Intrinsics> calibrations() {
  const Intrinsics plain{1500, 1200, 2678.823202452898, 1 / 3e-4, 749.1, 0.1 + 0.2};
  Intrinsics plumb_bob = plain, rational = plain, fisheye = plain;
  plumb_bob.distortion = rational.distortion = Distortion::Pinhole;
  plumb_bob.coefficients = {-0.28, 1 / 7.0, 1e-5, -2.5e-4, 0, 0, 0, 0};
  rational.coefficients = {12.1, 5.3, 1e-4, -2e-4, 0.21, 12.4, 9.8, 1.6};
  fisheye.distortion = Distortion::Fisheye;
  fisheye.coefficients = {-0.02, 0.004, -0.002, 3e-4, 0, 0, 0, 0};
  Intrinsics equidistant = fisheye;
  equidistant.coefficients = {};
  return {plain, plumb_bob, rational, fisheye, equidistant};
}

void expect_same(const Intrinsics& a, const Intrinsics& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.fx, b.fx);
  EXPECT_EQ(a.fy, b.fy);
  EXPECT_EQ(a.cx, b.cx);
  EXPECT_EQ(a.cy, b.cy);
  EXPECT_EQ(a.distortion, b.distortion);
  EXPECT_EQ(a.coefficients, b.coefficients);
}

/// Example from the documentation of ROS' camera_calibration.
const std::string kRos = R"(image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [430.21554970319971, 0.0, 306.6913434743704, 0.0, 430.53169252696676, 227.22480030078816, 0.0, 0.0, 1.0]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.33758562758914146, 0.11161239414304096, -0.00021819272592442094, -3.029195446330518e-05, 0.0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
projection_matrix:
  rows: 3
  cols: 4
  data: [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]
)";

std::string ros_with(const std::string& what, const std::string& with) {
  return replaced(what, with, kRos);
}

std::string ros_with_coefficients(const std::string& model, int columns,
                                  const std::string& numbers) {
  const std::size_t from = kRos.find("distortion_model"), to = kRos.find("rectification_matrix");
  return kRos.substr(0, from) + "distortion_model: " + model +
         "\ndistortion_coefficients:\n  rows: 1\n  cols: " + std::to_string(columns) +
         "\n  data: [" + numbers + "]\n" + kRos.substr(to);
}

TEST(CameraCalibration, MoreCoefficientsThatAre0ChangeNothing) {
  const std::string five = "-0.21, 0.08, 0.0011, -0.0007, 0.01";
  const std::string four = "0.01, -0.02, 0.003, 0.001";
  const auto same = [](const std::string& model, int count, const std::string& numbers,
                       const std::string& plain_model, int plain_count) {
    std::string longer = numbers;
    for (int n = plain_count; n < count; ++n) longer += ", 0.0";
    const auto plain =
        parse_calibration(ros_with_coefficients(plain_model, plain_count, numbers), "plain");
    const auto read = parse_calibration(ros_with_coefficients(model, count, longer), "longer");
    ASSERT_TRUE(plain) << plain.error().message;
    ASSERT_TRUE(read) << model << count << ": " << read.error().message;
    expect_same(*read, *plain);
  };
  for (const int count : {8, 12, 14}) same("plumb_bob", count, five, "plumb_bob", 5);
  for (const int count : {5, 8, 12, 14}) same("rational_polynomial", count, five, "plumb_bob", 5);
  same("rational_polynomial", 4, four, "plumb_bob", 4);
  for (const int count : {5, 8}) same("equidistant", count, four, "equidistant", 4);
}

TEST(CameraCalibration, ReadsCoefficientsBelowAShapeThatIsTooSmall) {
  const std::string eight = "-0.21, 0.08, 0.0011, -0.0007, 0.01, 0.02, 0.001, 0.002";
  const auto right = parse_calibration(ros_with_coefficients("rational_polynomial", 8, eight), "a");
  const auto read = parse_calibration(ros_with_coefficients("rational_polynomial", 5, eight), "a");
  ASSERT_TRUE(read) << read.error().message;
  expect_same(*read, *right);
}

TEST(CameraCalibration, ReadsWhatRosWrites) {
  const auto read = parse_calibration(kRos, "a.yaml");
  ASSERT_TRUE(read) << read.error().message;
  expect_same(*read, {640,
                      480,
                      430.21554970319971,
                      430.53169252696676,
                      306.6913434743704,
                      227.22480030078816,
                      Distortion::Pinhole,
                      {-0.33758562758914146, 0.11161239414304096, -0.00021819272592442094,
                       -3.029195446330518e-05}});
}

TEST(CameraCalibration, ReadsWhatRosWritesInBlockStyle) {
  // The same data in the style of other YAML writers.
  const std::string block =
      "image_height: 480\nimage_width: 640  # px\ncamera_name: 'narrow: stereo'\n"
      "distortion_model: rational_polynomial\n"
      "distortion_coefficients: {cols: 8, rows: 1, data: [1, 0, 0, 0, 0, 1, 0, -0.5]}\n"
      "camera_matrix:\n  cols: 3\n  data:\n  - 430\n  - 0\n  - 306.5\n  - 0\n  - 431\n  - 227\n"
      "  - 0\n  - 0\n  - 1\n  rows: 3\n";
  const auto read = parse_calibration(block, "a.yaml");
  ASSERT_TRUE(read) << read.error().message;
  expect_same(*read,
              {640, 480, 430, 431, 306.5, 227, Distortion::Pinhole, {1, 0, 0, 0, 0, 1, 0, -0.5}});
}

/// File of OpenCV's calibration program, written by OpenCV itself.
std::string written_by_opencv(const cv::Mat& coefficients, bool fisheye) {
  cv::FileStorage file(
      "", cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  file << "calibration_time"
       << "Tue 03 Mar 2026 10:00:00";
  file << "nr_of_frames" << 20;
  file << "image_width" << 1280 << "image_height" << 960;
  file << "board_width" << 9 << "board_height" << 6 << "square_size" << 25.0f;
  file.writeComment("flags: +fix_aspectRatio +fix_principal_point");
  file << "flags" << 6 << "fisheye_model" << fisheye;
  file << "camera_matrix" << cv::Mat(cv::Matx33d(900.5, 0, 639.25, 0, 1 / 0.0011, 479, 0, 0, 1));
  file << "distortion_coefficients" << coefficients;
  file << "avg_reprojection_error" << 0.21;
  file << "per_view_reprojection_errors" << cv::Mat(cv::Mat_<float>({0.2f, 0.22f}));
  return file.releaseAndGetString();
}

TEST(CameraCalibration, ReadsWhatOpenCvWrites) {
  const cv::Mat five = (cv::Mat_<double>(5, 1) << -0.1, 0.02, 1e-3, 2e-3, 0.03);
  // A rational model has room for thin prisms and a tilted sensor.
  const cv::Mat fourteen =
      (cv::Mat_<double>(1, 14) << 0.1, 0.02, 1e-3, 2e-3, 0.03, 0.3, 0.01, 2e-3, 0, 0, 0, 0, 0, 0);
  const cv::Mat four = (cv::Mat_<double>(4, 1) << 0.1, -0.02, 1e-3, 2e-3);
  Intrinsics truth{1280, 960, 900.5, 1 / 0.0011, 639.25, 479};
  for (const auto& [numbers, fisheye] :
       {std::pair{five, false}, {fourteen, false}, {four, false}, {four, true}}) {
    truth.distortion = fisheye ? Distortion::Fisheye : Distortion::Pinhole;
    truth.coefficients = {};
    std::copy_n(numbers.begin<double>(), std::min<std::size_t>(numbers.total(), 8),
                truth.coefficients.begin());
    const auto read = parse_calibration(written_by_opencv(numbers, fisheye), "a.yml");
    ASSERT_TRUE(read) << read.error().message;
    expect_same(*read, truth);
  }
  const auto none = parse_calibration(written_by_opencv(cv::Mat::zeros(5, 1, CV_64F), false), "a");
  ASSERT_TRUE(none) << none.error().message;
  EXPECT_EQ(none->distortion, Distortion::None);
}

TEST(CameraCalibration, ComesBackExactlyInBothFormats) {
  for (const Intrinsics& given : calibrations()) {
    for (const auto format : {CalibrationFormat::OpenCv, CalibrationFormat::Ros}) {
      const auto text = calibration_text(given, "A", format);
      ASSERT_TRUE(text) << text.error().message;
      const auto read = parse_calibration(*text, "a.yaml");
      ASSERT_TRUE(read) << read.error().message << "\n" << *text;
      expect_same(*read, given);
    }
  }
}

TEST(CameraCalibration, OpenCvReadsWhatIsWritten) {
  for (const Intrinsics& given : calibrations()) {
    const std::string text = calibration_text(given, "A", CalibrationFormat::OpenCv).value();
    const cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    EXPECT_EQ(static_cast<int>(file["image_width"]), given.width);
    EXPECT_EQ(static_cast<int>(file["image_height"]), given.height);
    EXPECT_EQ(static_cast<int>(file["fisheye_model"]), given.distortion == Distortion::Fisheye);
    const cv::Mat camera = file["camera_matrix"].mat();
    ASSERT_EQ(camera.type(), CV_64F);
    EXPECT_EQ(cv::norm(camera,
                       cv::Mat(cv::Matx33d(given.fx, 0, given.cx, 0, given.fy, given.cy, 0, 0, 1))),
              0);
    const cv::Mat coefficients = file["distortion_coefficients"].mat();
    ASSERT_EQ(coefficients.type(), CV_64F);
    for (std::size_t i = 0; i < coefficients.total(); ++i) {
      EXPECT_EQ(coefficients.at<double>(static_cast<int>(i)), given.coefficients[i]);
    }
  }
}

TEST(CameraCalibration, RosFileHasAllThatRosAsksFor) {
  const std::string text = calibration_text(calibrations()[1], "A", CalibrationFormat::Ros).value();
  std::size_t at = 0;
  for (const char* key :
       {"image_width: 1500\n", "image_height: 1200\n", "camera_name: A\n",
        "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [2678.823202452898, 0.0, ",
        "distortion_model: plumb_bob\n", "distortion_coefficients:\n  rows: 1\n", "  cols: 5\n",
        "rectification_matrix:\n", "projection_matrix:\n  rows: 3", "  cols: 4\n"}) {
    at = text.find(key, at);
    ASSERT_NE(at, std::string::npos) << key << " is not there, or not in its place:\n" << text;
  }
}

class CalibrationRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(CalibrationRefusal, SaysFileAndReasonInOneLine) {
  const auto read = parse_calibration(GetParam().text, "a.yaml");
  ASSERT_FALSE(read);
  expect_said(GetParam(), read.error());
  EXPECT_TRUE(read.error().message.starts_with("a.yaml:")) << read.error().message;
}

INSTANTIATE_TEST_SUITE_P(
    All, CalibrationRefusal,
    testing::Values(
        Refusal{"Empty", "", {"OpenCV or ROS"}}, Refusal{"Scalar", "42", {"OpenCV or ROS"}},
        Refusal{"List", "[1, 2]", {"OpenCV or ROS"}},
        Refusal{"NotYaml", "image_width: [640\n", {"a.yaml:2", "not valid YAML"}},
        Refusal{"EscapedLineEnd", "\"\\\n\": 3\nimage_width: \"\\\x01\"", {"not valid YAML"}},
        Refusal{"LineEndInAWord", ros_with("plumb_bob", "\"plumb\\nbob\""), {"plumb?bob"}},
        Refusal{"Binary", std::string("\x89PNG\r\n\x1a\n\0\0\0\r", 12), {}},
        Refusal{"DeeplyNested", std::string(200000, '['), {"not valid YAML"}},
        Refusal{"DeeplyNestedMaps",
                [] {
                  std::string text;
                  for (int i = 0; i < 50000; ++i) text += "{a: ";
                  return text;
                }(),
                {"not valid YAML"}},
        Refusal{"NoWidth", ros_with("image_width: 640\n", ""), {"image_width is missing"}},
        Refusal{"WordForWidth", ros_with("640", "wide"), {"image_width", "whole number"}},
        Refusal{"FractionForWidth", ros_with("640", "640.5"), {"image_width", "whole number"}},
        Refusal{"ListForWidth", ros_with("640", "[640]"), {"image_width", "whole number"}},
        Refusal{"HugeWidth", ros_with("640", "99999999999999"), {"image_width"}},
        Refusal{"WidthAboveAnyCamera", ros_with("640", "20000"), {"20000x480"}},
        Refusal{"NegativeHeight", ros_with("480", "-480"), {"640x-480"}},
        Refusal{"NoMatrix", ros_with("camera_matrix", "matrix"), {"camera_matrix is missing"}},
        Refusal{"MatrixWithoutShape", ros_with("  rows: 3\n", ""), {"camera_matrix", "rows"}},
        Refusal{"MatrixOfOtherShape", ros_with("rows: 3", "rows: 2"), {"9 numbers, not 2x3"}},
        Refusal{"HugeShape", ros_with("rows: 3", "rows: 4294967299"), {"camera_matrix", "rows"}},
        Refusal{"MatrixIsNumber",
                ros_with("camera_matrix:\n  rows: 3\n  cols: 3\n  data: ", "camera_matrix: 3\nx: "),
                {"camera_matrix must be a matrix"}},
        Refusal{"MatrixOfWords", ros_with("430.21554970319971", "far"), {"camera_matrix"}},
        Refusal{"MatrixNested", ros_with("430.21554970319971", "[430]"), {"camera_matrix"}},
        Refusal{"Skewed",
                ros_with("430.21554970319971, 0.0", "430.2, 0.125"),
                {"skew (0.125)", "cv::fisheye::CALIB_FIX_SKEW", "--fisheye-fix-skew"}},
        Refusal{"Mirrored",
                ros_with("0.0, 0.0, 1.0]\ndistortion", "0.0, 0.0, -1.0]\ndistortion"),
                {"[fx, 0, cx"}},
        Refusal{"NegativeFocalLength", ros_with("430.21554970319971", "-430"), {"fx"}},
        Refusal{"NanFocalLength", ros_with("430.21554970319971", ".nan"), {"fx"}},
        Refusal{"InfiniteFocalLength", ros_with("430.21554970319971", ".inf"), {"fx"}},
        Refusal{"BeyondDouble", ros_with("430.21554970319971", "1e999"), {"camera_matrix"}},
        Refusal{"NanCentre", ros_with("306.6913434743704", ".nan"), {"cx"}},
        Refusal{"UnknownModel", ros_with("plumb_bob", "kannala"), {"kannala", "equidistant"}},
        Refusal{"ModelIsList", ros_with("plumb_bob", "[plumb_bob]"), {"distortion_model"}},
        Refusal{"TooManyForModel",
                ros_with_coefficients("equidistant", 5, "0.1, 0, 0, 0, 0.01"),
                {"takes 4", "5 are given", "number 5 is not 0"}},
        Refusal{"SixthOfPlumbBob",
                ros_with_coefficients("plumb_bob", 8, "0.1, 0, 0, 0, 0, 0.02, 0, 0"),
                {"takes 4 or 5", "8 are given", "number 6 is not 0"}},
        Refusal{"ThinPrism",
                ros_with_coefficients("rational_polynomial", 12,
                                      "0.1, 0, 0, 0, 0, 0.02, 0, 0, 0, 0.001, 0, 0"),
                {"takes 8", "12 are given", "number 10 is not 0"}},
        Refusal{"TooFewForPlumbBob",
                ros_with_coefficients("plumb_bob", 3, "0.1, 0, 0"),
                {"takes 4 or 5", "3 are given"}},
        Refusal{"TooFewForModel",
                ros_with_coefficients("rational_polynomial", 6, "0.1, 0, 0, 0, 0, 0.02"),
                {"takes 8", "6 are given"}},
        Refusal{"FewerThanItsShape",
                ros_with_coefficients("plumb_bob", 8, "0.1, 0, 0, 0, 0"),
                {"5 numbers, not 1x8"}},
        Refusal{"NanCoefficient", ros_with("-0.33758562758914146", ".nan"), {"finite"}},
        Refusal{"Folds", ros_with("-0.33758562758914146", "-500"), {"folds"}},
        Refusal{"NoCoefficients",
                ros_with("distortion_coefficients", "coefficients"),
                {"distortion_coefficients is missing"}}),
    [](const auto& refusal) { return refusal.param.name; });

TEST(CameraCalibration, SurvivesEveryTruncationAndFlippedBit) {
  // Any damage must give a value or one line with the reason, never a crash.
  const std::string opencv =
      calibration_text(calibrations()[2], "A", CalibrationFormat::OpenCv).value();
  std::mt19937 random(1);
  for (const std::string& text : {kRos, opencv}) {
    for (std::size_t at = 0; at < text.size(); ++at) {
      std::string flipped = text;
      flipped[at] = static_cast<char>(flipped[at] ^ (1 << (random() % 8)));
      for (const std::string& broken : {text.substr(0, at), flipped}) {
        const auto read = parse_calibration(broken, "a.yaml");
        if (!read) {
          EXPECT_EQ(read.error().message.find('\n'), std::string::npos) << read.error().message;
        }
      }
    }
  }
}

Result<Intrinsics> read_file(const std::filesystem::path& file) {
  TextFiles files;
  return read_calibration(file, files);
}

TEST(CameraCalibration, FileIsReplacedWholeOrNotAtAll) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.yaml";
  const Intrinsics given = calibrations()[1];
  const auto written = write_calibration(file, calibrations()[3], "B", CalibrationFormat::OpenCv);
  ASSERT_TRUE(written) << written.error().message;
  ASSERT_TRUE(write_calibration(file, given, "A", CalibrationFormat::Ros));
  expect_same(read_file(file).value(), given);
  Intrinsics spoilt = given;
  spoilt.fx = 0;
  EXPECT_FALSE(write_calibration(file, spoilt, "A", CalibrationFormat::Ros));
  EXPECT_FALSE(write_calibration(file, given, "a: b\nc", CalibrationFormat::Ros));
  expect_same(read_file(file).value(), given);
  EXPECT_EQ(folder.files(), 1);
}

TEST(CameraCalibration, FileThatCannotBeReadIsRefusedByName) {
  for (const char* file : {"/nonexistent/a.yaml", "/tmp", "/dev/zero"}) {
    const auto read = read_file(file);
    ASSERT_FALSE(read) << file;
    EXPECT_TRUE(read.error().message.starts_with(std::string(file) + ": ")) << read.error().message;
  }
  EXPECT_FALSE(
      write_calibration("/nonexistent/a.yaml", calibrations()[0], "A", CalibrationFormat::OpenCv));
}

}  // namespace
}  // namespace orbwatch::app::files
