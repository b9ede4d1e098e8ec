// SPDX-License-Identifier: Apache-2.0
#include "app/watch/camera_watch.h"

#include <algorithm>
#include <utility>

#include "app/log.h"
#include "app/watch/alignment_checksum.h"

namespace orbwatch::app {

CameraWatch::Watched::Watched(const std::string& name, AlignmentWatch alignment_watch,
                              BallWatch ball_watch, Records& all_records,
                              std::shared_ptr<hal::SharedThreads> threads,
                              std::shared_ptr<hal::SharedThreads> outline_threads)
    : alignment(std::move(alignment_watch)),
      outline(name, std::move(outline_threads)),
      ball(std::move(ball_watch)),
      records(all_records),
      work(std::move(threads), [this] { look(); }) {}

void CameraWatch::Watched::look() {
  CameraWatchStatus seen;
  const hal::TimePoint taken = frame->metadata.exposure_start;
  alignment.observe(frame->picture, taken, seen);
  if (auto zero = alignment.take_zero_picture()) outline.check(std::move(*zero));
  outline.report(seen);
  if (cleaned.exchange(false)) ball.learn_anew();
  ball.observe(frame->picture, taken, seen);
  {
    const std::lock_guard lock(mutex);
    if (!is_outdated) {
      figures = seen;
      drift = alignment.drift();
    }
  }
  record();
  serve_readers();
  frame.reset();
  looking.store(false, std::memory_order_release);
}

/// Forgets figures and drift of before a fault: the camera may have been moved since. The zero and
/// the clean ball stay learnt.
void CameraWatch::Watched::forget() {
  const std::lock_guard lock(mutex);
  is_outdated = true;
  drift.reset();
  figures = {.outline_check = figures.outline_check,
             .outline_offset = figures.outline_offset,
             .outline_offset_px = figures.outline_offset_px};
}

void CameraWatch::Watched::record() {
  {
    const std::lock_guard lock(records.mutex);
    if (recorded.size() >= wanted) return;
  }
  RecordedPicture copy = copied(frame->picture, stamp.time_since_epoch());
  const std::lock_guard lock(records.mutex);
  if (recorded.size() < wanted) recorded.push_back(std::move(copy));
  records.added.notify_all();
}

void CameraWatch::Watched::serve_readers() {
  std::vector<std::function<void(RecordedPicture)>> served;
  {
    const std::lock_guard lock(mutex);
    served.swap(readers);
  }
  for (const auto& reader : served) reader(copied(frame->picture, stamp.time_since_epoch()));
}

CameraWatch::CameraWatch(const AlignedSite& site, const std::filesystem::path& folder,
                         const std::shared_ptr<hal::SharedThreads>& threads,
                         std::shared_ptr<hal::SharedThreads> outline_threads)
    : threads_(threads), outline_threads_(std::move(outline_threads)), copies_(threads) {
  for (std::size_t i = 0; i < site.cameras.size(); ++i) {
    cameras_.emplace_back();
    is_registered_.push_back(site.rig_camera(i).is_registered);
    if (!site.cameras[i].watch.enabled) continue;
    auto watched = make(site, i, folder);
    if (watched) {
      cameras_.back() = std::move(*watched);
    } else {
      log_camera(LogLevel::Warning, site.cameras[i].name,
                 "is not watched: " + watched.error().message);
    }
  }
}

Result<std::unique_ptr<CameraWatch::Watched>> CameraWatch::make(
    const AlignedSite& site, std::size_t camera, const std::filesystem::path& folder) {
  const auto& [name, in_rig, settings] = site.cameras[camera];
  const auto subject = align::drift_subject(site.rig, site.rig.cameras[in_rig]);
  if (!subject) return tl::unexpected(subject.error());
  auto alignment =
      AlignmentWatch::make(name, *subject, settings, folder, alignment_checksum(site, camera));
  if (!alignment) return tl::unexpected(alignment.error());
  auto ball =
      BallWatch::make(name, subject->width, subject->height, subject->outline, settings, folder);
  if (!ball) return tl::unexpected(ball.error());
  return std::make_unique<Watched>(name, std::move(*alignment), std::move(*ball), records_,
                                   threads_, outline_threads_);
}

CameraWatch::~CameraWatch() { stop(); }

void CameraWatch::stop() {
  copies_.stop();
  for (const auto& camera : cameras_) {
    if (!camera) continue;
    camera->work.cancel();
    camera->outline.stop();
  }
}

std::chrono::nanoseconds CameraWatch::cpu_time() const {
  std::chrono::nanoseconds time = copies_.cpu_time();
  for (const auto& camera : cameras_) {
    if (camera) time += camera->work.cpu_time() + camera->outline.cpu_time();
  }
  return time;
}

bool CameraWatch::Watched::can_look(const hal::FrameSet& set, std::size_t camera) const {
  return set.frames[camera] && !set.held[camera] && !looking.load(std::memory_order_acquire);
}

/// True: all cameras that are recorded can look at it. On a busy computer each would skip others'
/// pictures, and few would be of the same moment.
bool CameraWatch::can_record(const hal::FrameSet& set) const {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const Watched* const camera = cameras_[i].get();
    if (camera && camera->wanted > 0 && !camera->can_look(set, i)) return false;
  }
  return true;
}

void CameraWatch::accept_frames(const hal::FrameSet& set) {
  const bool is_record = can_record(set);
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    Watched* const camera = cameras_[i].get();
    if (!camera || !camera->can_look(set, i) || (camera->wanted > 0 && !is_record)) continue;
    camera->frame = set.frames[i];
    camera->stamp = set.stamp;
    camera->is_outdated = false;
    camera->looking.store(true, std::memory_order_release);
    camera->work.request();
  }
  copies_.accept(set);
}

void CameraWatch::accept(const Status& status) {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const hal::Fault fault = status.cameras[i].fault;
    faults_[i] = fault;
    if (cameras_[i] && fault != hal::Fault::None) cameras_[i]->forget();
  }
}

std::array<CameraWatchStatus, kMaxCameras> CameraWatch::figures() const {
  std::array<CameraWatchStatus, kMaxCameras> all;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (cameras_[i]) {
      const std::lock_guard lock(cameras_[i]->mutex);
      all[i] = cameras_[i]->figures;
    }
    if (!is_registered_[i]) all[i].alignment = AlignmentLevel::NotRegistered;
  }
  return all;
}

std::optional<align::DriftState> CameraWatch::drift(std::size_t camera) const {
  if (camera >= cameras_.size() || !cameras_[camera]) return std::nullopt;
  const std::lock_guard lock(cameras_[camera]->mutex);
  return cameras_[camera]->drift;
}

void CameraWatch::ask(std::size_t camera, std::function<void(RecordedPicture)> reader) {
  const std::lock_guard lock(cameras_[camera]->mutex);
  cameras_[camera]->readers.push_back(std::move(reader));
}

Result<std::vector<std::vector<RecordedPicture>>> CameraWatch::record(
    const std::vector<std::size_t>& cameras, std::size_t count, std::chrono::seconds patience,
    const align::WorkProgress& progress) {
  const auto set_wanted = [&](std::size_t wanted) {
    for (const std::size_t camera : cameras) cameras_[camera]->wanted = wanted;
  };
  // Pictures that each camera has.
  const auto recorded = [&] {
    std::size_t least = count;
    for (const std::size_t camera : cameras) {
      least = std::min(least, cameras_[camera]->recorded.size());
    }
    return least;
  };
  const auto end = hal::Clock::now() + patience;
  std::unique_lock lock(records_.mutex);
  set_wanted(count);
  Result<> wanted;
  for (std::size_t had = 0; had < count; had = recorded()) {
    const double share = static_cast<double>(had) / static_cast<double>(count);
    wanted = progress.at(align::WorkStep::Record, share);
    const auto is_more = [&] { return recorded() > had; };
    if (!wanted || !records_.added.wait_until(lock, progress.stop(), end, is_more)) break;
  }
  set_wanted(0);
  std::vector<std::vector<RecordedPicture>> records;
  records.reserve(cameras.size());
  for (const std::size_t camera : cameras) {
    records.push_back(std::exchange(cameras_[camera]->recorded, {}));
  }
  if (wanted) wanted = progress.at(align::WorkStep::Record, 1);
  if (!wanted) return tl::unexpected(wanted.error());
  for (const auto& record : records) {
    if (record.empty()) return fail("a camera delivers no pictures");
  }
  return records;
}

}  // namespace orbwatch::app
