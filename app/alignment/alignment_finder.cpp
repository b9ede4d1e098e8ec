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

/// Of both cameras, to register by: enough of a process' light at any usual rate.
constexpr std::size_t kPictures = 24;
constexpr std::size_t kPicturesOfLight = 8;
/// At a registration: one second's sparks may tell too little, the next are others.
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
  align::PlaceRequest request;
  align::UnplacedCamera marked;
  marked.outline = *seen->outline;
  if (added = points_[camera].mark(marked, request); !added) return added;
  request.cameras.push_back(std::move(marked));
  show(camera, request, nullptr);
  log_camera(
      LogLevel::Info, seen->name,
      "a point is marked, of " + std::to_string(points_[camera].size()) + " for place_camera");
  return {};
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

/// `placement`: null: there is none yet.
void AlignmentFinder::show(std::size_t camera, const align::PlaceRequest& request,
                           const align::Placement* placement) {
  const std::vector<align::PointMark>& marks = request.cameras.front().marks;
  std::vector<PlacedPoint> shown;
  for (std::size_t m = 0; m < marks.size(); ++m) {
    PlacedPoint point{request.points[marks[m].point], marks[m].pixel};
    if (placement) {
      const align::PlacedMark& placed = placement->cameras.front().marks[m];
      point.residual = placed.residual;
      point.is_outlier = placed.is_outlier;
    }
    shown.push_back(point);
  }
  const std::lock_guard lock(mutex_);
  shown_[camera] = std::move(shown);
}

Result<align::PlaceRequest> AlignmentFinder::place_request(const optics::Rig& rig,
                                                           std::size_t camera) const {
  const PlaceSettings& settings = site_.place;
  align::PlaceRequest request;
  request.centre = {align::BallCentre::Knowledge::Known, rig.ball.centre, 0};
  request.ball_radius = rig.ball.radius;
  request.sigma_px = settings.sigma_px;
  request.sigma_mm = settings.sigma_mm;
  auto unplaced = unplaced_camera(site_.camera_of(rig, camera), false);
  if (!unplaced) return tl::unexpected(unplaced.error());
  const auto seen = align::by_outline(rig, site_.camera_of(rig, camera));
  if (!seen) return tl::unexpected(seen.error());
  unplaced->outline = *seen->outline;
  unplaced->outline_sigma = settings.outline_sigma;
  if (const auto marked = points_[camera].mark(*unplaced, request); !marked) {
    return tl::unexpected(marked.error());
  }
  if (!settings.tags.empty()) {
    const auto recorded = watch_.record({camera}, 1, kPatience);
    if (!recorded) return tl::unexpected(recorded.error());
    std::vector<align::PrintedTag> tags;
    for (const TagSettings& tag : settings.tags) tags.push_back(tag.tag());
    const auto shown =
        align::mark_tags(recorded->front().front().picture, tags, *unplaced, request);
    if (!shown) return tl::unexpected(shown.error());
  }
  request.cameras.push_back(std::move(*unplaced));
  return request;
}

Result<AlignmentProposal> AlignmentFinder::place(const optics::Rig& rig, std::size_t camera) {
  const auto request = place_request(rig, camera);
  if (!request) return tl::unexpected(request.error());
  const auto placement = align::place(*request);
  if (!placement) return tl::unexpected(placement.error());
  show(camera, *request, &*placement);
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
