// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "proc/optics/rotation.h"
#include "proc/optics/vec.h"
#include "proc/optics/view_projection.h"
#include "tests/app/cli/command_line.h"
#include "tests/proc/reference_optics.h"
#include "tests/support/reference_data.h"
#include "tests/support/share.h"

/// Runs `orbwatch project` like a user: the program, files in, files out.
namespace orbwatch::tests {
namespace {

using optics::BallModel;
using optics::ViewKind;

const std::filesystem::path kOwnPhoto =
    std::filesystem::path(ORBWATCH_SOURCE_DIR) / "tests/data/room.jpg";

/// Photograph and its ball, as stated in its truth file.
struct Photo {
  std::filesystem::path file;
  optics::Outline ball;
  double alpha;
  optics::YawPitchRoll rotation;
};

const Photo kRoom{kOwnPhoto, {{399.5, 399.7}, 383, 385.6, 0}, 346, {0, 24, 1}};

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

class Project : public CommandLine {
 protected:
  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "project");
    return CommandLine::run(std::move(arguments));
  }

  cv::Mat projected(const std::vector<std::string>& arguments,
                    const std::string& name = "out.png") {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"-o", path(name)});
    EXPECT_EQ(run(all), 0) << said;
    EXPECT_EQ(said, "");
    return cv::imread(path(name), cv::IMREAD_UNCHANGED);
  }
};

cv::Vec3d bilinear(const cv::Mat& in, const optics::Vec2& p) {
  const auto at = [&](double x, double y) {
    return cv::Vec3d(in.at<cv::Vec3b>(std::clamp(static_cast<int>(y), 0, in.rows - 1),
                                      std::clamp(static_cast<int>(x), 0, in.cols - 1)));
  };
  const double x = std::floor(p.u), y = std::floor(p.v), wu = p.u - x, wv = p.v - y;
  return (at(x, y) * (1 - wu) + at(x + 1, y) * wu) * (1 - wv) +
         (at(x, y + 1) * (1 - wu) + at(x + 1, y + 1) * wu) * wv;
}

struct Score {
  int compared = 0;
  int off = 0;  ///< samples that differ by more than one grey level from the reference
};

Score compare(const cv::Mat& mine, const Photo& photo, const cv::Mat& source, BallModel::Kind kind,
              const optics::ViewSpec& spec) {
  const ReferenceBall reference{kind, photo.alpha, photo.ball, optics::rotation(photo.rotation)};
  const auto view = optics::ViewProjection::make(spec).value();
  const optics::Vec3 blind = reference.registration * optics::Vec3{0, -1, 0};
  Score score;
  for (int y = 0; y < spec.height; ++y) {
    for (int x = 0; x < spec.width; ++x) {
      const auto direction = view.direction(x, y).value();
      const auto pixel = reference.pixel(direction);
      if (!pixel) continue;
      const double from_centre = std::hypot((pixel->u - photo.ball.centre.u) / photo.ball.rx,
                                            (pixel->v - photo.ball.centre.v) / photo.ball.ry);
      if (from_centre > 1 - 2 / photo.ball.rx) continue;
      if (kind == BallModel::Kind::Classical &&
          optics::angle_between(direction, blind) < optics::radians(3)) {
        continue;
      }
      const cv::Vec3d truth = bilinear(source, *pixel);
      const auto& got = mine.at<cv::Vec3b>(y, x);
      for (int k = 0; k < 3; ++k, ++score.compared) score.off += std::abs(got[k] - truth[k]) > 1;
    }
  }
  return score;
}

class ProjectModels : public Project {
 protected:
  void expect_reference(const Photo& photo) {
    const cv::Mat source = cv::imread(photo.file.string());
    ASSERT_FALSE(source.empty());
    const std::array<std::pair<std::string, BallModel::Kind>, 3> models{
        {{"exact", BallModel::Kind::Exact},
         {"paper", BallModel::Kind::Paper},
         {"classical", BallModel::Kind::Classical}}};
    DrawnShare share(36);
    for (const auto& [name, kind] : models) {
      for (const double yaw : {0, 100, 180, -110}) {
        for (const double pitch : {0, -70, 50}) {
          if (!share.next()) continue;
          const optics::ViewSpec spec{ViewKind::Perspective, {yaw, pitch, 12}, 85, {}, 160, 120};
          std::vector<std::string> arguments{
              photo.file.string(),
              "--model",
              name,
              "--ball",
              text(photo.ball.centre.u) + "," + text(photo.ball.centre.v) + "," +
                  text(photo.ball.rx) + "," + text(photo.ball.ry) + "," + text(photo.ball.angle),
              "--rotation",
              text(photo.rotation.yaw) + "," + text(photo.rotation.pitch) + "," +
                  text(photo.rotation.roll),
              "--yaw",
              text(yaw),
              "--pitch",
              text(pitch),
              "--roll",
              "12",
              "--h-fov",
              "85",
              "--size",
              "160x120",
              "--interpolation",
              "bilinear",
              "--sharpness",
              "0"};
          if (kind != BallModel::Kind::Classical) {
            arguments.insert(arguments.end(), {"--alpha", text(photo.alpha)});
          }
          const cv::Mat mine = projected(arguments);
          ASSERT_EQ(mine.size(), cv::Size(160, 120));
          const Score score = compare(mine, photo, source, kind, spec);
          EXPECT_GT(score.compared, 20000) << name << " yaw " << yaw << " pitch " << pitch;
          EXPECT_LE(score.off, score.compared / 1000)
              << name << " yaw " << yaw << " pitch " << pitch;
        }
      }
    }
  }
};

TEST_F(ProjectModels, EqualTheReferenceOnOurOwnPhoto) { expect_reference(kRoom); }

TEST_F(ProjectModels, EqualTheReferenceOnTheLampsPhoto) {
  const auto file = reference_data() / "photos" / "lamp.jpg";
  ORBWATCH_REQUIRE_FILE(file);
  expect_reference({file, {{2060.06, 2062.06}, 1910.7, 1910.58, 0}, 340, {0, -17, 0}});
}

TEST_F(ProjectModels, EqualTheReferenceOnTheTablesPhoto) {
  const auto file = reference_data() / "photos" / "tisch.jpg";
  ORBWATCH_REQUIRE_FILE(file);
  expect_reference({file, {{1998.55, 1965.11}, 1875.79, 1883.44, 0}, 320, {0, 34, 1}});
}

const std::vector<std::string> kCentre{"--ball", "50,40,30", "--alpha", "340", "--size", "64x48"};

std::vector<std::string> with_input(const std::string& input, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{input};
  arguments.insert(arguments.end(), kCentre.begin(), kCentre.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(Project, KeepsDepthAndChannelsOfThePicture) {
  struct Case {
    std::string name;
    int type;
    cv::Scalar value;
  };
  for (const Case& c : {Case{"g8.png", CV_8UC1, {200}},
                        {"g16.png", CV_16UC1, {40001}},
                        {"c8.png", CV_8UC3, {10, 120, 250}},
                        {"c16.png", CV_16UC3, {1, 30000, 65535}},
                        {"g8.jpg", CV_8UC1, {90}}}) {
    const std::string input = write(c.name, cv::Mat(80, 100, c.type, c.value));
    const cv::Mat out = projected(with_input(input));
    ASSERT_EQ(out.type(), c.type) << c.name;
    EXPECT_EQ(cv::norm(out, cv::Mat(48, 64, c.type, c.value), cv::NORM_INF), 0) << c.name;
  }
}

TEST_F(Project, BlindDirectionsAreBlackOrTransparent) {
  const std::string input = write("in.png", cv::Mat(80, 100, CV_8UC3, cv::Scalar(9, 99, 199)));
  const std::vector<std::string> behind{"--yaw", "180", "--h-fov", "60"};
  const cv::Mat black = projected(with_input(input, behind));
  EXPECT_EQ(black.at<cv::Vec3b>(24, 32), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(black.at<cv::Vec3b>(2, 2), cv::Vec3b(9, 99, 199));
  auto clear = behind;
  clear.insert(clear.end(), {"--undefined", "transparent"});
  const cv::Mat transparent = projected(with_input(input, clear));
  ASSERT_EQ(transparent.type(), CV_8UC4);
  EXPECT_EQ(transparent.at<cv::Vec4b>(24, 32)[3], 0);
  EXPECT_EQ(transparent.at<cv::Vec4b>(2, 2), cv::Vec4b(9, 99, 199, 255));
}

TEST_F(Project, DistanceAndAlphaAreTwoWordsForOneThing) {
  const double alpha = 360 - 2 * optics::degrees(std::asin(1.0 / 12));
  std::ostringstream exact;
  exact << std::setprecision(17) << alpha;
  std::vector<std::string> view{kOwnPhoto.string(), "--ball", "400,400,384", "--size",
                                "200x100",          "--yaw",  "120"};
  auto by_alpha = view, by_distance = view;
  by_alpha.insert(by_alpha.end(), {"--alpha", exact.str()});
  by_distance.insert(by_distance.end(), {"--distance", "12"});
  EXPECT_EQ(cv::norm(projected(by_alpha, "a.png"), projected(by_distance, "b.png"), cv::NORM_INF),
            0);
}

// The reference is the same filter in OpenCV, which rounds once.
TEST_F(Project, ShowsColourSharpenedUnlessToldNotTo) {
  const cv::Mat photo = cv::imread(kOwnPhoto.string());
  cv::Mat mean, sharp;
  const cv::Mat weights = (cv::Mat_<double>(3, 1) << 4.0 / 19, 11.0 / 19, 4.0 / 19);
  cv::sepFilter2D(photo, mean, CV_64F, weights, weights, {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::Mat in_double;
  photo.convertTo(in_double, CV_64F);
  cv::Mat(in_double + 0.8 * (in_double - mean)).convertTo(sharp, CV_8U);
  const auto of = [](const std::string& input, std::vector<std::string> more) {
    std::vector<std::string> all{input,    "--ball",  "400,400,384", "--alpha", "346",
                                 "--size", "200x150", "--h-fov",     "60",      "--interpolation"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const std::string colour = kOwnPhoto.string();
  const cv::Mat shown = projected(of(colour, {"area"}), "a.png");
  const cv::Mat plain = projected(of(colour, {"area", "--sharpness", "0"}), "b.png");
  const cv::Mat truth =
      projected(of(write("sharp.png", sharp), {"area", "--sharpness", "0"}), "c.png");
  EXPECT_LE(cv::norm(shown, truth, cv::NORM_INF), 2);
  EXPECT_GT(cv::norm(shown, plain, cv::NORM_INF), 20);
  EXPECT_EQ(cv::norm(projected(of(colour, {"nearest"}), "d.png"),
                     projected(of(colour, {"nearest", "--sharpness", "0"}), "e.png"), cv::NORM_INF),
            0)
      << "nothing is blurred there";
}

TEST_F(Project, NeverSharpensWhatMayBeMeasured) {
  for (const int type : {CV_8UC1, CV_16UC1, CV_16UC3}) {
    cv::Mat noise(80, 100, type);
    cv::randu(noise, 0, CV_MAT_DEPTH(type) == CV_8U ? 256 : 65536);
    const std::string input = write("noise.png", noise);
    EXPECT_EQ(cv::norm(projected(with_input(input, {"--sharpness", "2"}), "a.png"),
                       projected(with_input(input, {"--sharpness", "0"}), "b.png"), cv::NORM_INF),
              0)
        << type;
  }
}

TEST_F(Project, WritesJpegByTheNamesEnding) {
  const std::string input = write("in.png", cv::Mat(80, 100, CV_8UC1, cv::Scalar(100)));
  EXPECT_EQ(projected(with_input(input), "out.JPG").size(), cv::Size(64, 48));
  std::ifstream file(path("out.JPG"), std::ios::binary);
  EXPECT_EQ(file.get(), 0xFF);
  EXPECT_EQ(file.get(), 0xD8);
}

TEST_F(Project, HelpNamesEveryOption) {
  EXPECT_EQ(run({"--help"}), 0);
  for (const char* option :
       {"--ball", "--alpha", "--distance", "--model", "--view", "--yaw", "--pitch", "--roll",
        "--h-fov", "--size", "--rotation", "--undefined", "--interpolation", "--sharpness", "-o"}) {
    EXPECT_NE(said.find(option), std::string::npos) << option;
  }
}

class ProjectMistake : public Project, public testing::WithParamInterface<Mistake> {};

TEST_P(ProjectMistake, IsOneLineAndNoFile) {
  write("good.png", cv::Mat(80, 100, CV_8UC3, cv::Scalar(1, 2, 3)));
  write("deep.png", cv::Mat(80, 100, CV_16UC1, cv::Scalar(1000)));
  {
    std::ifstream photo(kOwnPhoto, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(photo)), {});
    std::ofstream(path("cut.jpg"), std::ios::binary) << bytes.substr(0, bytes.size() / 2);
    std::ifstream png(path("good.png"), std::ios::binary);
    std::string chunk((std::istreambuf_iterator<char>(png)), {});
    std::ofstream(path("cut.png"), std::ios::binary) << chunk.substr(0, chunk.size() - 20);
    std::ofstream(path("text.png")) << "this is no picture";
    std::ofstream(path("empty.jpg")).flush();
  }
  expect_refused("project", GetParam());
}

std::vector<std::string> call(const std::string& input, const std::string& output,
                              std::vector<std::string> rest) {
  rest.insert(rest.begin(),
              {"DIR/" + input, "-o", output.starts_with("/") ? output : "DIR/" + output});
  return rest;
}

INSTANTIATE_TEST_SUITE_P(
    All, ProjectMistake,
    testing::Values(
        Mistake{"NoSuchPicture", call("none.png", "o.png", kCentre), {"none.png"}},
        Mistake{"TruncatedJpeg",
                call("cut.jpg", "o.png", {"--ball", "400,400,380", "--alpha", "346"}),
                {"cut.jpg"}},
        Mistake{"TruncatedPng", call("cut.png", "o.png", kCentre), {"cut.png"}},
        Mistake{"NoPicture", call("text.png", "o.png", kCentre), {"text.png", "JPEG", "PNG"}},
        Mistake{"EmptyPicture", call("empty.jpg", "o.png", kCentre), {"empty.jpg"}},
        Mistake{"BallOutside",
                call("good.png", "o.png", {"--ball", "500,40,30", "--alpha", "340"}),
                {"outside of the picture", "100x80"}},
        Mistake{"TooSharp",
                call("good.png", "o.png",
                     {"--ball", "50,40,30", "--alpha", "340", "--sharpness", "2.5"}),
                {"--sharpness", "0 to 2"}},
        Mistake{"NoRadius",
                call("good.png", "o.png", {"--ball", "50,40,0", "--alpha", "340"}),
                {"radius"}},
        Mistake{"NanBall",
                call("good.png", "o.png", {"--ball", "50,nan,30", "--alpha", "340"}),
                {"--ball", "nan"}},
        Mistake{"TwoNumbers",
                call("good.png", "o.png", {"--ball", "50,40", "--alpha", "340"}),
                {"CX,CY,R"}},
        Mistake{"AlphaTooSmall",
                call("good.png", "o.png", {"--ball", "50,40,30", "--alpha", "180"}),
                {"(180, 360]"}},
        Mistake{"AlphaTooLarge",
                call("good.png", "o.png", {"--ball", "50,40,30", "--alpha", "361"}),
                {"(180, 360]"}},
        Mistake{"AlphaNan",
                call("good.png", "o.png", {"--ball", "50,40,30", "--alpha", "nan"}),
                {"--alpha", "finite"}},
        Mistake{"CameraInBall",
                call("good.png", "o.png", {"--ball", "50,40,30", "--distance", "0.9"}),
                {"above 1"}},
        Mistake{"NeitherAlphaNorDistance",
                call("good.png", "o.png", {"--ball", "50,40,30"}),
                {"alpha", "distance"}},
        Mistake{"ClassicalWithAlpha",
                call("good.png", "o.png",
                     {"--ball", "50,40,30", "--model", "classical", "--alpha", "340"}),
                {"neither"}},
        Mistake{
            "SizeZero",
            call("good.png", "o.png", {"--ball", "50,40,30", "--alpha", "340", "--size", "0x48"}),
            {"0x48", "16384"}},
        Mistake{"SizeHuge",
                call("good.png", "o.png",
                     {"--ball", "50,40,30", "--alpha", "340", "--size", "16385x48"}),
                {"16384"}},
        Mistake{
            "SizeWithoutCross",
            call("good.png", "o.png", {"--ball", "50,40,30", "--alpha", "340", "--size", "640"}),
            {"WxH"}},
        Mistake{
            "FovTooWide",
            call("good.png", "o.png", {"--ball", "50,40,30", "--alpha", "340", "--h-fov", "180"}),
            {"h_fov", "below 180"}},
        Mistake{"FovZero",
                call("good.png", "o.png", {"--ball", "50,40,30", "--alpha", "340", "--h-fov", "0"}),
                {"h_fov"}},
        Mistake{"YawNan",
                call("good.png", "o.png", {"--ball", "50,40,30", "--alpha", "340", "--yaw", "nan"}),
                {"--yaw"}},
        Mistake{
            "UnknownModel",
            call("good.png", "o.png", {"--ball", "50,40,30", "--alpha", "340", "--model", "best"}),
            {"exact, paper, classical"}},
        Mistake{"UnknownOption", call("good.png", "o.png", {"--bell", "50,40,30"}), {"--bell"}},
        Mistake{"MissingValue", call("good.png", "o.png", {"--ball"}), {"--ball"}},
        Mistake{"NoBall", call("good.png", "o.png", {"--alpha", "340"}), {"--ball"}},
        Mistake{"NoOutput", {"DIR/good.png", "--ball", "50,40,30", "--alpha", "340"}, {"-o"}},
        Mistake{"NoInput", {"-o", "DIR/o.png", "--ball", "50,40,30", "--alpha", "340"}, {"IN"}},
        Mistake{"NoSuchFolder",
                call("good.png", "no/such/o.png", kCentre),
                {"no/such/o.png", "No such file"}},
        Mistake{"OutputIsAFolder", call("good.png", "/proc/o.png", kCentre), {"/proc/o.png"}},
        Mistake{"UnknownEnding", call("good.png", "o.tiff", kCentre), {".png"}},
        Mistake{"DeepJpeg", call("deep.png", "o.jpg", kCentre), {"8 bit"}},
        Mistake{"TransparentJpeg",
                call("good.png", "o.jpg",
                     {"--ball", "50,40,30", "--alpha", "340", "--undefined", "transparent"}),
                {"transparency"}}),
    [](const auto& mistake) { return mistake.param.name; });

}  // namespace
}  // namespace orbwatch::tests
