// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/gradients/place_fit.h"

#include "proc/align/register/gradients/place_agreement.h"

namespace orbwatch::align {
namespace {

constexpr int kFitSteps = 20;
constexpr int kHalvings = 4;
constexpr double kArrived = 0.03;  // share of a difference's step
constexpr double kKept = 1e-3;     // standard deviation of an outline that is kept, px

cv::Matx33d turn_block(const PlaceCovariance& m) { return m.get_minor<3, 3>(0, 0); }

/// Information on the outline from the sought camera's own.
PlaceCovariance prior_information(const SoughtCamera& sought) {
  const double pixels = sought.keeps_outline ? kKept : kOutlinePrior;
  const double sigma = 2 * pixels / optics::mean_radius(*sought.camera.outline);
  PlaceCovariance information;
  for (int n = 3; n < kPlaceUnknowns; ++n) information(n, n) = 1 / (sigma * sigma);
  return information;
}

/// Gauss-Newton iteration with the log likelihood weight * agreement - prior.
class Fit {
 public:
  Fit(const PlaceAgreement& agreement, const PlaceCovariance& normal, const PlaceCovariance& prior,
      const PlaceChange& from_prior, double step)
      : agreement_(agreement),
        prior_(prior),
        from_prior_(from_prior),
        step_(step),
        slope_(agreement.slope({}, step)),
        // A slope's covariance is its information where the likelihood is right.
        weight_(3 / cv::trace(turn_block(normal).inv() * turn_block(slope_.covariance))),
        inverse_((normal * weight_ + prior).inv(cv::DECOMP_CHOLESKY)),
        value_(value_at({})) {}

  void run() {
    for (int n = 0; n < kFitSteps; ++n) {
      const double length = advance();
      if (length < kArrived * step_) break;
    }
  }
  const PlaceChange& change() const { return change_; }
  /// Covariance that holds also where the likelihood is wrong (Huber's sandwich).
  PlaceCovariance covariance() const {
    return inverse_ * (slope_.covariance * (weight_ * weight_) + prior_) * inverse_;
  }

 private:
  double value_at(const PlaceChange& change) const {
    const PlaceChange off = change + from_prior_;
    return weight_ * agreement_.at(change) - 0.5 * off.dot(prior_ * off);
  }

  /// The length of a step that improves the value; 0 if none does.
  double advance() {
    PlaceChange move = inverse_ * (slope_.sum * weight_ - prior_ * (change_ + from_prior_));
    const double length = cv::norm(move);
    if (length > 2 * step_) move *= 2 * step_ / length;
    double next = value_at(change_ + move);
    for (int n = 0; n < kHalvings && !(next > value_); ++n) {
      move *= 0.5;
      next = value_at(change_ + move);
    }
    if (!(next > value_)) return 0;
    change_ += move;
    value_ = next;
    slope_ = agreement_.slope(change_, step_);
    return cv::norm(move);
  }

  const PlaceAgreement& agreement_;
  PlaceCovariance prior_;
  PlaceChange from_prior_;
  double step_;
  PlaceAgreement::Slope slope_;
  double weight_;
  PlaceCovariance inverse_;
  PlaceChange change_;
  double value_;
};

}  // namespace

Result<PlaceFit> fit_place(const std::vector<GradientField::Sample>& samples,
                           const GradientField& field, const SoughtCamera& sought,
                           const Place& start, double smoothing) {
  const auto shifts = PlaceShifts::make(sought, start);
  if (!shifts) return tl::unexpected(shifts.error());
  const PlaceAgreement agreement(samples, *shifts, field);
  const double step = optics::radians(0.4 * smoothing);
  const auto normal = agreement.normal_matrix(step);
  if (!normal) return tl::unexpected(normal.error());
  const optics::Outline& given = *sought.camera.outline;
  Fit fit(agreement, *normal, prior_information(sought), outline_change(given, start.outline),
          step);
  fit.run();
  return PlaceFit{changed(start, fit.change()), fit.covariance()};
}

}  // namespace orbwatch::align
