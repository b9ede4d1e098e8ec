// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_finder.h"

#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "app/alignment/drift_correction.h"
#include "app/alignment/figure_text.h"
#include "app/alignment/found_outline.h"
#include "app/alignment/placement.h"
#include "app/alignment/reference_sigma.h"
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

/// The proposal of a drift's correction. Its error is that of the alignment in force and that of
/// the motion. Unknown for a camera with a lens whose drift has no known cause: the correction
/// assumes that the ball moved, and the camera may have turned.
AlignmentProposal drift_proposal(const CameraAlignment& alignment, const optics::RigCamera& camera,
                                 const align::DriftState& drift) {
  AlignmentProposal proposal{alignment, "drift",
                             figure_text("moved by", drift.direction_error, "deg rms") + ", "};
  if (camera.intrinsics && drift.cause == align::DriftCause::Unknown) {
    proposal.quality += "sigma unknown: whether the camera or the ball moved is not known";
    return proposal;
  }
  proposal.direction_sigma = std::hypot(drift.direction_sigma, kReferenceSigma);
  proposal.quality += figure_text("sigma", proposal.direction_sigma, "deg") + ", " +
                      figure_text("of that", drift.direction_sigma, "deg by the drift");
  return proposal;
}

/// Settings of a registration of that camera. Its pose, if it has one, is measured and keeps its
/// place to the ball; an outline was detected or stated by hand, and is refined.
RegistrationSettings settings_for(const optics::RigCamera& camera) {
  return {.outline_sigma = camera.pose ? 0 : kFoundOutlineSigma};
}

}  // namespace

Result<Found> AlignmentFinder::detect(const optics::Rig& rig, std::size_t camera,
                                      const align::WorkProgress& progress) const {
  const auto pictures = watch_.record({camera}, 1, kPatience, progress);
  if (!pictures) return tl::unexpected(pictures.error());
  const auto ball = progress.at(align::WorkStep::Detect).and_then([&] {
    return found_outline((*pictures)[0].front().picture);
  });
  if (!ball) return tl::unexpected(ball.error());
  return with_outline(rig, site_.camera_of(rig, camera), ball->outline)
      .map([&](const CameraAlignment& alignment) {
        return Found{
            AlignmentProposal{alignment, "detect", figure_text("confidence", ball->confidence)}};
      });
}

Result<Found> AlignmentFinder::register_to_first(const optics::Rig& rig, std::size_t camera,
                                                 const align::WorkProgress& progress) const {
  for (int attempt = 1;; ++attempt) {
    const auto pictures = watch_.record({0, camera}, kPictures, kPatience, progress);
    if (!pictures) return tl::unexpected(pictures.error());
    auto found = register_by(rig, camera, (*pictures)[0], (*pictures)[1], progress);
    if (found) return Found{std::move(*found)};
    if (attempt == kAttempts) return tl::unexpected(found.error());
  }
}

Result<AlignmentProposal> AlignmentFinder::register_by(
    const optics::Rig& rig, std::size_t camera, const std::vector<RecordedPicture>& of_first,
    const std::vector<RecordedPicture>& of_camera, const align::WorkProgress& progress) const {
  // Pictures of one frame set have its time.
  const auto pictures = simultaneous(of_first, of_camera, std::chrono::nanoseconds(0));
  if (!pictures) return tl::unexpected(pictures.error());
  const optics::RigCamera& sought = site_.camera_of(rig, camera);
  return register_camera(rig, site_.camera_of(rig, 0), sought, *pictures, settings_for(sought),
                         progress)
      .map([](const FoundRegistration& found) { return found.proposal; });
}

Result<Found> AlignmentFinder::correct(std::size_t camera) const {
  const auto drift = watch_.drift(camera);
  if (!drift) return fail("no picture was seen yet");
  const optics::RigCamera& in_force = site_.rig_camera(camera);
  return corrected(site_.rig, in_force, *drift).map([&](const CameraAlignment& alignment) {
    return Found{drift_proposal(alignment, in_force, *drift)};
  });
}

Result<Found> AlignmentFinder::mark(const optics::Rig& rig, std::size_t camera,
                                    const optics::Vec3& point,
                                    const std::optional<optics::Vec2>& pixel,
                                    const align::WorkProgress& progress) const {
  const auto seen = align::by_outline(rig, site_.camera_of(rig, camera));
  if (!seen) return tl::unexpected(seen.error());
  PointMarks marks = marks_of(camera);
  Result<> added;
  if (pixel) {
    added = marks.add(point, *pixel);
  } else {
    const auto recorded = watch_.record({camera}, kPicturesOfLight, kPatience, progress);
    if (!recorded) return tl::unexpected(recorded.error());
    std::vector<Picture> pictures;
    for (const RecordedPicture& one : recorded->front()) pictures.push_back(one.picture);
    added = marks.add(point, pictures, *seen->outline);
  }
  if (!added) return tl::unexpected(added.error());
  const auto marked = marks.points(*seen->outline);
  if (!marked) return tl::unexpected(marked.error());
  std::vector<PlacedPoint> shown;
  for (const auto& [at, known] : *marked) shown.push_back({known, at});
  return Found{{}, MarkedPoints{std::move(marks), std::move(shown)}};
}

PointMarks AlignmentFinder::marks_of(std::size_t camera) const {
  const std::lock_guard lock(mutex_);
  return points_[camera].marks;
}

void AlignmentFinder::set_points(std::size_t camera, MarkedPoints points) {
  const std::lock_guard lock(mutex_);
  points_[camera] = std::move(points);
}

bool AlignmentFinder::forget_point(std::size_t camera, const optics::Vec3& point) {
  const std::lock_guard lock(mutex_);
  if (!points_[camera].marks.remove(point)) return false;
  std::erase_if(points_[camera].shown, [&](const PlacedPoint& shown) {
    return shown.point.x == point.x && shown.point.y == point.y && shown.point.z == point.z;
  });
  return true;
}

void AlignmentFinder::forget_points(std::size_t camera) {
  const std::lock_guard lock(mutex_);
  points_[camera] = {};
}

std::vector<PlacedPoint> AlignmentFinder::points(std::size_t camera) const {
  const std::lock_guard lock(mutex_);
  return points_[camera].shown;
}

Result<align::PlaceRequest> AlignmentFinder::request_for(
    const optics::Rig& rig, std::size_t camera, const PointMarks& marks,
    const align::WorkProgress& progress) const {
  const PlaceSettings& settings = site_.place;
  auto unplaced = unplaced_camera(site_.camera_of(rig, camera), false);
  if (!unplaced) return tl::unexpected(unplaced.error());
  const auto seen = align::by_outline(rig, site_.camera_of(rig, camera));
  if (!seen) return tl::unexpected(seen.error());
  unplaced->outline = *seen->outline;
  unplaced->outline_sigma = settings.outline_sigma;
  const auto points = marks.points(*seen->outline);
  if (!points) return tl::unexpected(points.error());
  std::vector<std::vector<RecordedPicture>> recorded;
  std::vector<align::PrintedTag> tags;
  for (const TagSettings& tag : settings.tags) tags.push_back(tag.tag());
  if (!tags.empty()) {
    auto pictures = watch_.record({camera}, 1, kPatience, progress);
    if (!pictures) return tl::unexpected(pictures.error());
    recorded = std::move(*pictures);
  }
  auto request = place_request(rig, settings, align::BallCentre::Knowledge::Known);
  const Picture* const picture = recorded.empty() ? nullptr : &recorded[0].front().picture;
  return add_camera(request, std::move(*unplaced), *points, picture, tags, progress).map([&] {
    return std::move(request);
  });
}

Result<Found> AlignmentFinder::place(const optics::Rig& rig, std::size_t camera,
                                     const align::WorkProgress& progress) const {
  PointMarks marks = marks_of(camera);
  const auto request = request_for(rig, camera, marks, progress);
  if (!request) return tl::unexpected(request.error());
  const auto placement =
      progress.at(align::WorkStep::Solve).and_then([&] { return align::place(*request); });
  if (!placement) return tl::unexpected(placement.error());
  log_camera(LogLevel::Info, site_.camera_of(rig, camera).name,
             "marked minus shown: " + residuals_text(*request, *placement, 0));
  Found found{{}, MarkedPoints{std::move(marks), placed_points(*request, *placement, 0)}};
  const auto alignment = rig_alignment(*request, *placement);
  if (!alignment) {
    found.refusal = alignment.error().message;
    return found;
  }
  const align::PlacedCamera& placed = placement->cameras.front();
  found.proposal = {alignment->cameras.front(),
                    "place by " + std::to_string(placed.marks.size()) + " points",
                    figure_text("residual", rms_residual(placed), "px rms") + ", " +
                        figure_text("sigma", placed.direction_sigma, "deg"),
                    placed.direction_sigma};
  return found;
}

}  // namespace orbwatch::app
