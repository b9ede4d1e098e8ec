#include "app/watch/alignment_desk.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <utility>

#include "app/files/calibration_file.h"
#include "app/log.h"
#include "app/model/utc_text.h"
#include "app/state/state_folder.h"
#include "app/watch/drift_correction.h"
#include "app/watch/placed_alignment.h"
#include "proc/align/detect/ball_detector.h"
#include "proc/align/register/camera_registration.h"

namespace orbwatch::app {
namespace {

/// Of both cameras, to register by: enough of a process' light at any usual rate.
constexpr std::size_t kPictures = 24;
constexpr std::size_t kPicturesOfLight = 8;
constexpr std::chrono::seconds kPatience{10};

std::string two_digits(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// The pictures that were taken at the same moments.
align::SimultaneousPictures together(const std::vector<RecordedPicture>& reference,
                                     const std::vector<RecordedPicture>& camera) {
  align::SimultaneousPictures pictures;
  for (const RecordedPicture& one : reference) {
    const auto other = std::ranges::find(camera, one.time, &RecordedPicture::time);
    if (other == camera.end()) continue;
    pictures.reference.push_back(one.picture);
    pictures.camera.push_back(other->picture);
  }
  return pictures;
}

/// Whether an entry of that camera is younger than `age`. An unreadable file is another's concern.
bool is_young(const std::filesystem::path& file, const std::string& camera,
              std::chrono::minutes age) {
  TextFiles files;
  const auto entries = load_calibrations(file, files);
  const auto oldest = utc_text(std::chrono::system_clock::now() - age);
  return entries && std::ranges::any_of(*entries, [&](const CalibrationEntry& entry) {
           // Moments of one form: the later text is the later moment.
           return camera_of(entry).camera == camera && entry.time > oldest;
         });
}

/// Keeps a damaged file aside. The alignments that run.
Result<std::vector<CalibrationEntry>> load_running(const std::filesystem::path& file,
                                                   const FileTexts& running, const Error& damage) {
  return keep_damaged(file).and_then([&](const std::filesystem::path& kept) {
    log_line(LogLevel::Warning, damage.message + "; it is kept as " + kept.string());
    TextFiles files(running);
    return load_calibrations(file, files);
  });
}

/// Accepts it into the file, a damaged one of which is written anew with what is `running`. Error:
/// as load_calibrations(), keep_damaged() and save_calibrations().
Result<int> put_in_force(const std::filesystem::path& file, const FileTexts& running,
                         const CalibrationEntry& entry) {
  TextFiles files;
  auto entries = load_calibrations(file, files);
  if (!entries) entries = load_running(file, running, entries.error());
  if (!entries) return tl::unexpected(entries.error());
  accept(*entries, entry);
  return save_calibrations(file, *entries).map([&] { return entries->back().number; });
}

}  // namespace

AlignmentDesk::AlignmentDesk(const Resolved& site, CameraWatch& watch,
                             std::function<void()> restart)
    : site_(site),
      watch_(watch),
      restart_(std::move(restart)),
      work_(thread_, [this] { work(); }),
      correction_(thread_, [this] { correct_lasting_drifts(); }) {
  for (auto& sigma : direction_sigmas_) sigma = signals::kNotValid;
}

AlignmentDesk::~AlignmentDesk() { stop(); }

void AlignmentDesk::start() {
  const auto corrects = [](const CameraSettings& camera) {
    return camera.watch.enabled && camera.watch.correct;
  };
  if (std::ranges::any_of(site_.site.cameras, corrects)) correction_.request();
}

void AlignmentDesk::stop() {
  watch_.cancel_records();
  correction_.cancel();
  work_.cancel();
}

CommandResult AlignmentDesk::detect(std::size_t camera) {
  return begin(camera, watch_.is_watched(camera), [this, camera] { return detected(camera); });
}

CommandResult AlignmentDesk::register_to_first(std::size_t camera) {
  const bool is_possible = camera != 0 && watch_.is_watched(camera) && watch_.is_watched(0);
  return begin(camera, is_possible, [this, camera] { return registered(camera); });
}

CommandResult AlignmentDesk::correct(std::size_t camera) {
  return begin(camera, watch_.is_watched(camera), [this, camera] { return drifted(camera); });
}

CommandResult AlignmentDesk::mark(std::size_t camera, const optics::Vec3& point) {
  return begin(camera, watch_.is_watched(camera),
               [this, camera, point] { return marked(camera, point); });
}

CommandResult AlignmentDesk::place(std::size_t camera) {
  const bool is_possible =
      watch_.is_watched(camera) && (point_counts_[camera] > 0 || !site_.site.place.tags.empty());
  return begin(camera, is_possible, [this, camera] { return placed(camera); });
}

CommandResult AlignmentDesk::forget_points(std::size_t camera) {
  if (camera >= site_.site.cameras.size()) return CommandResult::ArgumentOutOfRange;
  const std::lock_guard lock(mutex_);
  if (busy_) return CommandResult::Busy;
  if (point_counts_[camera] == 0) return CommandResult::NotPossible;
  points_[camera].clear();
  point_counts_[camera] = 0;
  return CommandResult::Done;
}

CommandResult AlignmentDesk::begin(std::size_t camera, bool is_possible, Task task) {
  if (camera >= site_.site.cameras.size()) return CommandResult::ArgumentOutOfRange;
  if (!is_possible) return CommandResult::NotPossible;
  {
    const std::lock_guard lock(mutex_);
    if (busy_) return CommandResult::Busy;
    busy_ = camera;
    task_ = std::move(task);
    forget_proposal(camera);
    states_[camera] = ProposalState::Working;
  }
  work_.request();
  return CommandResult::Done;
}

void AlignmentDesk::work() {
  const Finding found = task_();
  const std::lock_guard lock(mutex_);
  const std::size_t camera = *std::exchange(busy_, std::nullopt);
  if (!found) {
    states_[camera] = ProposalState::Refused;
    log_camera(LogLevel::Warning, name(camera), "nothing found: " + found.error().message);
    return;
  }
  if (!*found) {
    states_[camera] = ProposalState::None;
    return;
  }
  const Proposal& proposal = **found;
  proposals_[camera] = proposal.entry;
  direction_sigmas_[camera] = proposal.direction_sigma;
  states_[camera] = ProposalState::Ready;
  log_camera(LogLevel::Info, name(camera),
             "an alignment is proposed: " + proposal.entry.method + ", " + proposal.entry.quality +
                 "; accept_alignment puts it in force, with a restart");
}

void AlignmentDesk::forget_proposal(std::size_t camera) {
  proposals_[camera].reset();
  direction_sigmas_[camera] = signals::kNotValid;
  states_[camera] = ProposalState::None;
}

Result<AlignmentDesk::Proposal> AlignmentDesk::detected(std::size_t camera) const {
  const auto pictures = watch_.record({camera}, 1, kPatience);
  if (!pictures) return tl::unexpected(pictures.error());
  const auto ball = align::detect_ball((*pictures)[0].front().picture);
  if (!ball) return tl::unexpected(ball.error());
  if (!ball->is_confident()) return fail("the ball was not found for sure: " + ball->reason);
  return with_outline(site_.rig, site_.rig_camera(camera), ball->outline)
      .map([&](const CameraAlignment& alignment) {
        Proposal found{entry(alignment)};
        found.entry.method = "detect";
        found.entry.quality = two_digits("confidence %.2f", ball->confidence);
        return found;
      });
}

Result<AlignmentDesk::Proposal> AlignmentDesk::registered(std::size_t camera) const {
  const auto pictures = watch_.record({0, camera}, kPictures, kPatience);
  if (!pictures) return tl::unexpected(pictures.error());
  const auto simultaneous = together((*pictures)[0], (*pictures)[1]);
  if (simultaneous.camera.empty()) return fail("the cameras took no pictures at the same moment");
  const auto reference = optics::ball_projection(site_.rig, site_.rig_camera(0));
  if (!reference) return tl::unexpected(reference.error());
  const auto turnable = align::by_outline(site_.rig, site_.rig_camera(camera));
  if (!turnable) return tl::unexpected(turnable.error());
  const align::SoughtCamera sought{simultaneous.camera.front(), site_.rig, *turnable};
  const auto found = align::register_camera(simultaneous, *reference, sought,
                                            align::RegistrationMethod::Auto, [](const auto&) {});
  if (!found) return tl::unexpected(found.error());
  const align::Registration& best = found->registration;
  Proposal result{
      entry({.camera = name(camera), .outline = best.outline, .registration = best.rotation}),
      std::ranges::max(align::sigmas(best))};
  const auto* const method = std::ranges::find(align::kRegistrationMethods, found->method,
                                               [](const auto& word) { return word.value; });
  result.entry.method = "register by " + std::string(method->name);
  result.entry.quality = two_digits("residual %.2f deg rms", best.residual) +
                         two_digits(", sigma %.2f deg", result.direction_sigma);
  return result;
}

Result<AlignmentDesk::Proposal> AlignmentDesk::drifted(std::size_t camera) const {
  const auto drift = watch_.drift(camera);
  if (!drift) return fail("no picture was seen yet");
  return corrected(site_.rig, site_.rig_camera(camera), *drift)
      .map([&](const CameraAlignment& alignment) {
        Proposal found{entry(alignment), drift->direction_sigma};
        found.entry.method = "drift";
        found.entry.quality = two_digits("moved by %.2f deg rms", drift->direction_error) +
                              two_digits(", sigma %.2f deg", drift->direction_sigma);
        return found;
      });
}

AlignmentDesk::Finding AlignmentDesk::marked(std::size_t camera, const optics::Vec3& point) {
  const auto seen = align::by_outline(site_.rig, site_.rig_camera(camera));
  if (!seen) return tl::unexpected(seen.error());
  const auto recorded = watch_.record({camera}, kPicturesOfLight, kPatience);
  if (!recorded) return tl::unexpected(recorded.error());
  std::vector<Picture> pictures;
  for (const RecordedPicture& one : recorded->front()) pictures.push_back(one.picture);
  const auto added = points_[camera].add(point, pictures, *seen->outline);
  if (!added) return tl::unexpected(added.error());
  point_counts_[camera] = points_[camera].size();
  log_camera(
      LogLevel::Info, name(camera),
      "a point is marked, of " + std::to_string(points_[camera].size()) + " for place_camera");
  return std::nullopt;
}

/// For the outline that is in force.
Result<align::PlaceRequest> AlignmentDesk::place_request(std::size_t camera) const {
  const PlaceSettings& settings = site_.site.place;
  align::PlaceRequest request;
  request.centre = {align::BallCentre::Knowledge::Known, site_.rig.ball.centre, 0};
  request.ball_radius = site_.rig.ball.radius;
  request.sigma_px = settings.sigma_px;
  request.sigma_mm = settings.sigma_mm;
  auto unplaced = unplaced_camera(site_.rig_camera(camera), false);
  if (!unplaced) return tl::unexpected(unplaced.error());
  const auto seen = align::by_outline(site_.rig, site_.rig_camera(camera));
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

Result<AlignmentDesk::Proposal> AlignmentDesk::placed(std::size_t camera) const {
  const auto request = place_request(camera);
  if (!request) return tl::unexpected(request.error());
  const auto placement = align::place(*request);
  if (!placement) return tl::unexpected(placement.error());
  log_camera(LogLevel::Info, name(camera),
             "marked minus shown: " + residuals_text(*request, *placement, 0));
  return rig_alignment(*request, *placement).map([&](const RigAlignment& alignment) {
    const align::PlacedCamera& found = placement->cameras.front();
    Proposal proposal{entry(alignment.cameras.front()), found.direction_sigma};
    proposal.entry.method = "place by " + std::to_string(found.marks.size()) + " points";
    proposal.entry.quality = two_digits("residual %.2f px rms", rms_residual(found)) +
                             two_digits(", sigma %.2f deg", found.direction_sigma);
    return proposal;
  });
}

void AlignmentDesk::correct_lasting_drifts() {
  const auto now = hal::Clock::now();
  for (std::size_t i = 0; i < site_.site.cameras.size(); ++i) {
    if (site_.site.cameras[i].watch.correct) correct_lasting_drift(i, now);
  }
  correction_.request(now + std::chrono::seconds(1));
}

void AlignmentDesk::correct_lasting_drift(std::size_t camera, hal::TimePoint now) {
  const auto drift = watch_.drift(camera);
  if (!drift || drift->level < align::DriftLevel::Warning) {
    drifting_since_[camera].reset();
    return;
  }
  if (!drifting_since_[camera]) drifting_since_[camera] = now;
  const auto file = calibration_file(state_folder(site_.site.state_folder));
  if (now - *drifting_since_[camera] < kLastingDrift ||
      is_young(file, name(camera), kPauseOfCorrections)) {
    return;
  }
  auto found = drifted(camera);
  if (!found) return;
  {
    const std::lock_guard lock(mutex_);
    if (busy_) return;
    proposals_[camera] = std::move(found->entry);
  }
  accept(camera);
}

/// For the rig file as it is now: what changed it since the start is not in force yet.
CalibrationEntry AlignmentDesk::entry(const CameraAlignment& alignment) const {
  CalibrationEntry entry;
  entry.rig = rig_checksum(site_.site.rig.path).value_or(0);
  entry.alignment.cameras.push_back(alignment);
  return entry;
}

CommandResult AlignmentDesk::accept(std::size_t camera) {
  if (camera >= site_.site.cameras.size()) return CommandResult::ArgumentOutOfRange;
  const std::lock_guard lock(mutex_);
  if (busy_) return CommandResult::Busy;
  if (!proposals_[camera]) return CommandResult::NotPossible;
  const auto file = calibration_file(state_folder(site_.site.state_folder));
  const auto number = put_in_force(file, site_.calibration, *proposals_[camera]);
  if (!number) {
    log_camera(LogLevel::Error, name(camera), "not accepted: " + number.error().message);
    return CommandResult::NotCarriedOut;
  }
  log_camera(LogLevel::Info, name(camera),
             "alignment " + std::to_string(*number) + " is accepted; restarts with it");
  forget_proposal(camera);
  restart_();
  return CommandResult::Done;
}

CommandResult AlignmentDesk::discard(std::size_t camera) {
  if (camera >= site_.site.cameras.size()) return CommandResult::ArgumentOutOfRange;
  const std::lock_guard lock(mutex_);
  if (busy_ == camera) return CommandResult::Busy;
  if (states_[camera] == ProposalState::None) return CommandResult::NotPossible;
  forget_proposal(camera);
  return CommandResult::Done;
}

void AlignmentDesk::report(std::array<CameraWatchStatus, kMaxCameras>& figures) const {
  for (std::size_t i = 0; i < figures.size(); ++i) {
    figures[i].proposal = states_[i];
    figures[i].proposal_error = direction_sigmas_[i];
    figures[i].marked_points = point_counts_[i];
  }
}

}  // namespace orbwatch::app
