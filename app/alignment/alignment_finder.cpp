// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_finder.h"

#include <chrono>
#include <string>
#include <utility>

#include "app/alignment/drift_correction.h"
#include "app/alignment/figure_text.h"
#include "app/alignment/found_outline.h"
#include "app/alignment/placement.h"
#include "app/alignment/registration.h"
#include "app/log.h"

namespace orbwatch::app {
namespace {

/// Pictures of each camera for a registration: enough of a process' light at any usual rate.
constexpr std::size_t kPictures = 24;
constexpr std::size_t kPicturesOfLight = 8;
/// Attempts to register: the sparks of one second may be too few.
constexpr int kAttempts = 3;
constexpr std::chrono::seconds kPatience{10};

}  // namespace

Result<AlignmentProposal> AlignmentFinder::detect(const optics::Rig& rig,
                                                  std::size_t camera) const {
  const auto pictures = watch_.record({camera}, 1, kPatience);
  if (!pictures) return tl::unexpected(pictures.error());
  const auto ball = found_outline((*pictures)[0].front().picture);
  if (!ball) return tl::unexpected(ball.error());
  return with_outline(rig, site_.camera_of(rig, camera), ball->outline)
      .map([&](const CameraAlignment& alignment) {
        return AlignmentProposal{alignment, "detect", figure_text("confidence", ball->confidence)};
      });
}

Result<AlignmentProposal> AlignmentFinder::register_to_first(const optics::Rig& rig,
                                                             std::size_t camera) const {
  for (int attempt = 1;; ++attempt) {
    const auto pictures = watch_.record({0, camera}, kPictures, kPatience);
    if (!pictures) return tl::unexpected(pictures.error());
    auto found = register_by(rig, camera, (*pictures)[0], (*pictures)[1]);
    if (found || attempt == kAttempts) return found;
  }
}

Result<AlignmentProposal> AlignmentFinder::register_by(
    const optics::Rig& rig, std::size_t camera, const std::vector<RecordedPicture>& of_first,
    const std::vector<RecordedPicture>& of_camera) const {
  // Pictures of one frame set have its time.
  const auto pictures = simultaneous(of_first, of_camera, std::chrono::nanoseconds(0));
  if (!pictures) return tl::unexpected(pictures.error());
  return register_camera(rig, site_.camera_of(rig, 0), site_.camera_of(rig, camera), *pictures, {},
                         [](const auto&) {})
      .map([](const FoundRegistration& found) { return found.proposal; });
}

Result<AlignmentProposal> AlignmentFinder::correct(const optics::Rig& rig,
                                                   std::size_t camera) const {
  const auto drift = watch_.drift(camera);
  if (!drift) return fail("no picture was seen yet");
  return corrected(rig, site_.camera_of(rig, camera), *drift)
      .map([&](const CameraAlignment& alignment) {
        return AlignmentProposal{alignment, "drift",
                                 figure_text("moved by", drift->direction_error, "deg rms") + ", " +
                                     figure_text("sigma", drift->direction_sigma, "deg"),
                                 drift->direction_sigma};
      });
}

Result<> AlignmentFinder::mark(const optics::Rig& rig, std::size_t camera,
                               const optics::Vec3& point,
                               const std::optional<optics::Vec2>& pixel) {
  const auto seen = align::by_outline(rig, site_.camera_of(rig, camera));
  if (!seen) return tl::unexpected(seen.error());
  Result<> added;
  if (pixel) {
    added = points_[camera].add(point, *pixel);
  } else {
    const auto recorded = watch_.record({camera}, kPicturesOfLight, kPatience);
    if (!recorded) return tl::unexpected(recorded.error());
    std::vector<Picture> pictures;
    for (const RecordedPicture& one : recorded->front()) pictures.push_back(one.picture);
    added = points_[camera].add(point, pictures, *seen->outline);
  }
  if (!added) return added;
  const auto marked = points_[camera].points(*seen->outline);
  if (!marked) return tl::unexpected(marked.error());
  std::vector<PlacedPoint> shown;
  for (const auto& [at, known] : *marked) shown.push_back({known, at});
  show(camera, std::move(shown));
  log_camera(
      LogLevel::Info, seen->name,
      "a point is marked, of " + std::to_string(points_[camera].size()) + " for place_camera");
  return {};
}

bool AlignmentFinder::forget_point(std::size_t camera, const optics::Vec3& point) {
  if (!points_[camera].remove(point)) return false;
  const std::lock_guard lock(mutex_);
  std::erase_if(shown_[camera], [&](const PlacedPoint& shown) {
    return shown.point.x == point.x && shown.point.y == point.y && shown.point.z == point.z;
  });
  return true;
}

void AlignmentFinder::forget_points(std::size_t camera) {
  points_[camera].clear();
  const std::lock_guard lock(mutex_);
  shown_[camera].clear();
}

std::vector<PlacedPoint> AlignmentFinder::points(std::size_t camera) const {
  const std::lock_guard lock(mutex_);
  return shown_[camera];
}

void AlignmentFinder::show(std::size_t camera, std::vector<PlacedPoint> points) {
  const std::lock_guard lock(mutex_);
  shown_[camera] = std::move(points);
}

Result<align::PlaceRequest> AlignmentFinder::request_for(const optics::Rig& rig,
                                                         std::size_t camera) const {
  const PlaceSettings& settings = site_.place;
  auto unplaced = unplaced_camera(site_.camera_of(rig, camera), false);
  if (!unplaced) return tl::unexpected(unplaced.error());
  const auto seen = align::by_outline(rig, site_.camera_of(rig, camera));
  if (!seen) return tl::unexpected(seen.error());
  unplaced->outline = *seen->outline;
  unplaced->outline_sigma = settings.outline_sigma;
  const auto points = points_[camera].points(*seen->outline);
  if (!points) return tl::unexpected(points.error());
  std::vector<std::vector<RecordedPicture>> recorded;
  std::vector<align::PrintedTag> tags;
  for (const TagSettings& tag : settings.tags) tags.push_back(tag.tag());
  if (!tags.empty()) {
    auto pictures = watch_.record({camera}, 1, kPatience);
    if (!pictures) return tl::unexpected(pictures.error());
    recorded = std::move(*pictures);
  }
  auto request = place_request(rig, settings, align::BallCentre::Knowledge::Known);
  const Picture* const picture = recorded.empty() ? nullptr : &recorded[0].front().picture;
  return add_camera(request, std::move(*unplaced), *points, picture, tags).map([&] {
    return std::move(request);
  });
}

Result<AlignmentProposal> AlignmentFinder::place(const optics::Rig& rig, std::size_t camera) {
  const auto request = request_for(rig, camera);
  if (!request) return tl::unexpected(request.error());
  const auto placement = align::place(*request);
  if (!placement) return tl::unexpected(placement.error());
  show(camera, placed_points(*request, *placement, 0));
  log_camera(LogLevel::Info, site_.camera_of(rig, camera).name,
             "marked minus shown: " + residuals_text(*request, *placement, 0));
  return rig_alignment(*request, *placement).map([&](const RigAlignment& alignment) {
    const align::PlacedCamera& found = placement->cameras.front();
    return AlignmentProposal{alignment.cameras.front(),
                             "place by " + std::to_string(found.marks.size()) + " points",
                             figure_text("residual", rms_residual(found), "px rms") + ", " +
                                 figure_text("sigma", found.direction_sigma, "deg"),
                             found.direction_sigma};
  });
}

}  // namespace orbwatch::app
