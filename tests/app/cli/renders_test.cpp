// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "app/files/rig/rig_file.h"
#include "proc/optics/resolution.h"
#include "proc/optics/view_projection.h"
#include "tests/support/reference_data.h"
#include "tests/support/rendered_scene.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

/// Runs the program on rendered pictures with truth: rig file, grid, kernel, PNG, scored by an
/// independent script.
namespace orbwatch::tests {
namespace {

constexpr const char* kPython = "/usr/bin/python3";  // Debian's, for which its OpenCV is built

std::filesystem::path score_script() {
  return reference_data() / ".." / "metric" / "score_views.py";
}

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

class Renders : public testing::Test {
 protected:
  void expect_success(const std::vector<std::string>& program) {
    Subprocess process(program, folder / "said");
    const int code = process.wait();
    said = process.output();
    ASSERT_EQ(code, 0) << program[1] << ": " << said;
  }
  void write(const std::filesystem::path& file, const std::string& content) {
    std::ofstream(file, std::ios::binary) << content;
  }

  TemporaryFolder folder;
  std::string said;
};

/// Scores of one scene and camera, by the script's names.
class Scores {
 public:
  explicit Scores(const std::filesystem::path& report)
      : file_(report, cv::FileStorage::READ | cv::FileStorage::FORMAT_JSON) {}

  double of(const std::string& row, const std::string& figure) const {
    const cv::FileNode node = file_.root()[row][figure];
    EXPECT_TRUE(node.isReal() || node.isInt()) << row << " has no " << figure;
    return static_cast<double>(node);
  }

  /// Prints one line of the table in the README of proc/optics.
  void print(const std::string& title) const {
    std::cout << "| " << title;
    for (const char* row : {"far A", "far B", "near A", "near B", "near50 A"}) {
      char cell[96];
      std::snprintf(cell, sizeof cell, " | %.3f / %.2f, %.1f, %.3f", of(row, "median_deg"),
                    of(row, "p95_deg"), of(row, "psnr_db"), of(row, "ssim"));
      std::cout << cell;
    }
    for (const char* row : {"far C", "near C"}) {
      char cell[64];
      std::snprintf(cell, sizeof cell, " | %.2f / %.2f", of(row, "rmse_k"), of(row, "rmse_cold_k"));
      std::cout << cell;
    }
    std::cout << " |\n";
  }

 private:
  cv::FileStorage file_;
};

class RenderedViews : public Renders {
 protected:
  /// Projects every view of every scene and camera that has truth, and lets the script score it.
  /// `rig` returns a scene's rig file.
  Scores score(const std::string& model,
               const std::function<std::string(const RenderedScene&)>& rig) {
    for (const char* name : {"far", "near", "near50"}) {
      const RenderedScene scene(name);
      const auto rig_file = folder / (std::string(name) + ".toml");
      write(rig_file, rig(scene));
      for (const RenderedCamera& camera : scene.cameras()) {
        for (std::size_t n = 0; n < scene.views().size(); ++n) {
          const RenderedView& view = scene.views()[n];
          const bool thermal = camera.name == "C";
          const int width = thermal ? view.thermal_width : view.width;
          const int height = thermal ? view.thermal_height : view.height;
          if (width == 0) continue;
          const std::string out =
              std::string(name) + "_" + camera.name + "_view" + std::to_string(n) + ".png";
          expect_success({ORBWATCH_PROGRAM,
                          "project",
                          "--rig",
                          rig_file.string(),
                          "--camera",
                          camera.name + "=" + camera.picture.string(),
                          "-o",
                          (folder / out).string(),
                          "--model",
                          model,
                          "--yaw",
                          text(view.yaw),
                          "--pitch",
                          text(view.pitch),
                          "--roll",
                          text(view.roll),
                          "--h-fov",
                          text(view.h_fov),
                          "--size",
                          std::to_string(width) + "x" + std::to_string(height)});
        }
      }
    }
    const auto report = folder / "report.json";
    expect_success({kPython, score_script().string(), rendered_pictures().string(),
                    folder.path().string(), "--json", report.string()});
    return Scores(report);
  }
};

std::string with_geometry(const RenderedScene& scene) {
  return scene.rig(RenderedScene::Known::BoxAndTable);
}

TEST_F(RenderedViews, ExactModelWithTheMachinesGeometry) {
  ORBWATCH_REQUIRE_FILE(score_script());
  const Scores scores = score("exact", with_geometry);
  scores.print("exact, box + table");
  struct Gate {
    const char* row;
    double median, p95, psnr, ssim;
  };
  for (const Gate& gate :
       {Gate{"far A", 0.02, 0.12, 30.2, 0.94}, Gate{"far B", 0.03, 0.12, 24.9, 0.86},
        Gate{"near A", 0.02, 0.12, 27.1, 0.92}, Gate{"near B", 0.03, 0.12, 24.6, 0.85},
        Gate{"near50 A", 0.02, 0.12, 28.6, 0.93}}) {
    EXPECT_LE(scores.of(gate.row, "median_deg"), gate.median) << gate.row;
    EXPECT_LE(scores.of(gate.row, "p95_deg"), gate.p95) << gate.row;
    EXPECT_GE(scores.of(gate.row, "psnr_db"), gate.psnr) << gate.row;
    EXPECT_GE(scores.of(gate.row, "ssim"), gate.ssim) << gate.row;
    EXPECT_GE(scores.of(gate.row, "tracked"), 0.57) << gate.row;
  }
  EXPECT_LE(scores.of("far C", "rmse_cold_k"), 1.9);
  EXPECT_LE(scores.of("near C", "rmse_cold_k"), 2.95);
}

/// Other models, for comparison with the product. Only tests/acceptance/run runs these.
using OtherModels = RenderedViews;

TEST_F(OtherModels, ExactModelWithoutTheMachinesGeometry) {
  ORBWATCH_REQUIRE_FILE(score_script());
  const Scores scores = score(
      "exact", [](const RenderedScene& scene) { return scene.rig(RenderedScene::Known::Nothing); });
  scores.print("exact, far field");
  EXPECT_LE(scores.of("far A", "median_deg"), 0.2);
  EXPECT_GE(scores.of("near A", "median_deg"), 2) << "else the near scene shows no parallax";
}

// The paper's method, with the same outline, alpha and rotation, must reach its known error on
// these pictures, so that the comparison is fair.
TEST_F(OtherModels, PaperAndClassicalModel) {
  ORBWATCH_REQUIRE_FILE(score_script());
  const auto uncalibrated = [](const RenderedScene& scene) { return scene.uncalibrated_rig(); };
  const Scores paper = score("paper", uncalibrated);
  paper.print("paper");
  EXPECT_NEAR(paper.of("far A", "psnr_db"), 12.0, 0.5);
  EXPECT_NEAR(paper.of("far A", "median_deg"), 3.25, 0.3);
  EXPECT_NEAR(paper.of("far C", "rmse_cold_k"), 5.28, 0.5);
  const Scores classical = score("classical", uncalibrated);
  classical.print("classical");
  EXPECT_LE(classical.of("far A", "psnr_db"), 13);
}

/// Panorama of the far scene by cameras A and B.
class TwoCameras : public Renders {
 protected:
  static constexpr int kWidth = 2048, kHeight = 1024;

  /// Returns BGRA; transparent where no camera has coverage.
  cv::Mat panorama(const std::vector<std::string>& names) {
    const RenderedScene scene("far");
    const auto rig_file = folder / "far.toml", out = folder / "panorama.png";
    write(rig_file, with_geometry(scene));
    std::vector<std::string> program{ORBWATCH_PROGRAM,  "project",   "--rig",
                                     rig_file.string(), "--view",    "equirectangular",
                                     "--size",          "2048x1024", "--undefined",
                                     "transparent",     "-o",        out.string()};
    for (const RenderedCamera& camera : scene.cameras()) {
      if (std::find(names.begin(), names.end(), camera.name) == names.end()) continue;
      program.insert(program.end(), {"--camera", camera.name + "=" + camera.picture.string()});
    }
    expect_success(program);
    return cv::imread(out.string(), cv::IMREAD_UNCHANGED);
  }

  /// Camera with more pixels per degree: 0 A, 1 B.
  cv::Mat sharper() {
    const auto rig = app::files::load_rig(folder / "far.toml").value();
    const auto a = optics::ball_projection(rig, rig.cameras[0]).value();
    const auto b = optics::ball_projection(rig, rig.cameras[1]).value();
    const auto view = optics::ViewProjection::make(
                          {optics::ViewKind::Equirectangular, {}, {}, {}, kWidth, kHeight})
                          .value();
    cv::Mat which(kHeight, kWidth, CV_8UC1);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const auto direction = view.direction(x, y).value();
        which.at<std::uint8_t>(y, x) =
            optics::resolution(b, direction) > optics::resolution(a, direction);
      }
    }
    return which;
  }
};

/// Excess of a step in the picture over its truth, in levels: median over all neighbours on
/// different sides of a border in `side`.
double seam_step(const cv::Mat& picture, const cv::Mat& truth, const cv::Mat& side) {
  std::vector<double> steps;
  const auto compare = [&](cv::Point p, cv::Point q) {
    if (side.at<std::uint8_t>(p) == side.at<std::uint8_t>(q)) return;
    double step = 0;
    for (int k = 0; k < 3; ++k) {
      const int mine = picture.at<cv::Vec4b>(p)[k] - picture.at<cv::Vec4b>(q)[k];
      const int real = truth.at<cv::Vec3b>(p)[k] - truth.at<cv::Vec3b>(q)[k];
      step += std::abs(mine - real) / 3.0;
    }
    steps.push_back(step);
  };
  for (int y = 0; y + 1 < side.rows; ++y) {
    for (int x = 0; x + 1 < side.cols; ++x) {
      compare({x, y}, {x + 1, y});
      compare({x, y}, {x, y + 1});
    }
  }
  EXPECT_GT(steps.size(), 200U) << "there is no seam";
  if (steps.empty()) return 255;
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                   steps.end());
  return steps[steps.size() / 2];
}

TEST_F(TwoCameras, ShowTheWholeSphereWithoutASeam) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures() / "gt" / "pano_color.png");
  const cv::Mat a = panorama({"A"}), b = panorama({"B"}), both = panorama({"A", "B"});
  ASSERT_EQ(both.type(), CV_8UC4);
  cv::Mat seen_a, seen_b, seen;
  cv::extractChannel(a, seen_a, 3);
  cv::extractChannel(b, seen_b, 3);
  cv::extractChannel(both, seen, 3);
  EXPECT_LT(cv::countNonZero(seen_a), kWidth * kHeight) << "A has no blind cone";
  EXPECT_LT(cv::countNonZero(seen_b), kWidth * kHeight) << "B has no blind cone";
  EXPECT_EQ(cv::countNonZero(seen), kWidth * kHeight);

  const cv::Mat truth = cv::imread((rendered_pictures() / "gt" / "pano_color.png").string());
  const double two_percent = 0.02 * 255;
  for (const auto& [name, side] : {std::pair{"where A ends", seen_a},
                                   {"where B ends", seen_b},
                                   {"where B takes over", sharper()}}) {
    const double step = seam_step(both, truth, side);
    std::cout << "step " << name << ": " << step / 2.55 << " % of full scale\n";
    EXPECT_LE(step, two_percent) << name;
  }
}

}  // namespace
}  // namespace orbwatch::tests
