// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/step_edge.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "proc/align/condition/normal_step.h"

namespace orbwatch::align {
namespace {

constexpr double kAlong = 3.5;  // px along the edge that are assumed to be straight
constexpr double kSharpest = 0.2, kWidest = kEdgeReach / 2.0;  // px
constexpr double kMostRamp = 0.4;     // share of the contrast, over the whole reach
constexpr double kMostMisfit = 0.05;  // share of the contrast, rms, besides noise

struct Sample {
  double across, along;  ///< px, relative to the first guess of the normal
  double brightness;
};

/// low + contrast Phi((across cos turn + along sin turn - offset) / sigma) + ramp across.
class StepModel {
 public:
  using Scalar = double;
  enum Parameter { kLow, kContrast, kOffset, kTurn, kLogSigma, kRamp, kParameters };
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = kParameters };

  explicit StepModel(const std::vector<Sample>& samples) : samples_(samples) {}

  int NumResiduals() const { return static_cast<int>(samples_.size()); }

  /// The interface that Ceres' TinySolver needs: the Jacobian is stored by columns.
  bool operator()(const double* p, double* residuals, double* jacobian) const {
    const double c = std::cos(p[kTurn]), s = std::sin(p[kTurn]), sigma = std::exp(p[kLogSigma]);
    const std::size_t rows = samples_.size();
    for (std::size_t n = 0; n < rows; ++n) {
      const Sample& sample = samples_[n];
      const double x = (sample.across * c + sample.along * s - p[kOffset]) / sigma;
      const auto [step, density] = normal_step(x);
      residuals[n] = p[kLow] + p[kContrast] * step + p[kRamp] * sample.across - sample.brightness;
      if (jacobian == nullptr) continue;
      const double slope = p[kContrast] * density;
      jacobian[kLow * rows + n] = 1;
      jacobian[kContrast * rows + n] = step;
      jacobian[kOffset * rows + n] = -slope / sigma;
      jacobian[kTurn * rows + n] = slope * (sample.along * c - sample.across * s) / sigma;
      jacobian[kLogSigma * rows + n] = -slope * x;
      jacobian[kRamp * rows + n] = sample.across;
    }
    return true;
  }

 private:
  const std::vector<Sample>& samples_;
};

std::vector<Sample> samples_around(const cv::Mat& brightness, const cv::Point& pixel,
                                   double normal) {
  std::vector<Sample> samples;
  const double c = std::cos(normal), s = std::sin(normal);
  for (int dv = -kEdgeReach; dv <= kEdgeReach; ++dv) {
    const float* const row = brightness.ptr<float>(pixel.y + dv);
    for (int du = -kEdgeReach; du <= kEdgeReach; ++du) {
      const double across = du * c + dv * s, along = dv * c - du * s;
      if (std::abs(across) > kEdgeReach || std::abs(along) > kAlong) continue;
      samples.push_back({across, along, static_cast<double>(row[pixel.x + du])});
    }
  }
  return samples;
}

using Solver = ceres::TinySolver<StepModel>;

/// Levels from the means of both ends; half a pixel of blur.
Solver::Parameters first_guess(const std::vector<Sample>& samples) {
  double low = 0, high = 0;
  int lows = 0, highs = 0;
  for (const Sample& sample : samples) {
    if (sample.across < -2) low += sample.brightness, ++lows;
    if (sample.across > 2) high += sample.brightness, ++highs;
  }
  low /= lows;
  Solver::Parameters guess;
  guess << low, high / highs - low, 0, 0, 0, 0;
  return guess;
}

/// The standard error of the logarithm of sigma, at the measured rms misfit.
double error_of_log_sigma(const StepModel& model, const Solver::Parameters& p, double misfit) {
  const int rows = model.NumResiduals();
  Eigen::VectorXd residuals(rows);
  Eigen::Matrix<double, Eigen::Dynamic, StepModel::kParameters> jacobian(rows,
                                                                         StepModel::kParameters);
  model(p.data(), residuals.data(), jacobian.data());
  const Eigen::Matrix<double, StepModel::kParameters, StepModel::kParameters> information =
      jacobian.transpose() * jacobian;
  const Solver::Parameters unit = Solver::Parameters::Unit(StepModel::kLogSigma);
  return misfit * std::sqrt(std::max(0.0, information.ldlt().solve(unit)(StepModel::kLogSigma)));
}

}  // namespace

std::optional<StepEdge> fit_step_edge(const cv::Mat& brightness, const cv::Point& pixel,
                                      double normal, double noise) {
  const cv::Rect inside(kEdgeReach, kEdgeReach, brightness.cols - 2 * kEdgeReach,
                        brightness.rows - 2 * kEdgeReach);
  if (!inside.contains(pixel)) return std::nullopt;
  const std::vector<Sample> samples = samples_around(brightness, pixel, normal);
  const StepModel model(samples);
  Solver solver;
  solver.options.max_num_iterations = 15;
  solver.options.function_tolerance = 1e-4;
  Solver::Parameters p = first_guess(samples);
  const Solver::Summary& summary = solver.Solve(model, &p);
  const double contrast = std::abs(p[StepModel::kContrast]);
  const double sigma = std::exp(p[StepModel::kLogSigma]);
  const double misfit =
      std::sqrt(2 * summary.final_cost / static_cast<double>(samples.size() - p.size()));
  const bool is_step = std::isfinite(contrast + sigma + misfit) && sigma > kSharpest &&
                       sigma < kWidest && std::abs(p[StepModel::kOffset]) < 2 &&
                       std::abs(p[StepModel::kTurn]) < 0.5 &&
                       std::abs(p[StepModel::kRamp]) * 2 * kEdgeReach < kMostRamp * contrast &&
                       misfit < std::hypot(1.3 * noise, kMostMisfit * contrast);
  if (!is_step) return std::nullopt;
  return StepEdge{contrast, sigma, sigma * error_of_log_sigma(model, p, std::max(misfit, noise))};
}

}  // namespace orbwatch::align
