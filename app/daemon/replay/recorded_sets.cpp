// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/replay/recorded_sets.h"

#include <algorithm>
#include <utility>

#include "hal/recording/camera_channels.h"
#include "hal/recording/camera_stream.h"
#include "hal/recording/messages.h"

namespace orbwatch::app::daemon {
namespace {

namespace recording = hal::recording;

/// The frame of this set, and the one that is held.
constexpr std::size_t kBuffers = 2;

bool has_camera(const hal::mcap::Summary& summary, const std::string& camera) {
  const auto cameras = recording::cameras_in(summary);
  return std::ranges::find(cameras, camera) != cameras.end();
}

std::size_t stated_states(const hal::mcap::Summary& summary) {
  std::size_t count = 0;
  for (const auto& [id, messages] : summary.message_counts) {
    const auto channel = summary.channels.find(id);
    const bool is_state =
        channel != summary.channels.end() &&
        recording::type_of(summary, channel->second) == recording::SetNumbers::kType;
    count += is_state ? messages : 0;
  }
  return count;
}

}  // namespace

RecordedSets::RecordedSets(recorder::RecordedStates states, recording::RecordedClock clock)
    : states_(std::move(states)),
      clock_(clock),
      stated_(stated_states(states_.reader().summary())),
      end_(states_.reader().summary().statistics().message_end_time) {}

Result<RecordedSets> RecordedSets::open(const std::filesystem::path& file,
                                        const std::vector<std::string>& cameras,
                                        const std::vector<hal::SyncPolicy>& policies) {
  auto states = recorder::RecordedStates::open(file);
  if (!states) return tl::unexpected(states.error());
  const auto clock = recording::RecordedClock::of(states->reader());
  if (!clock) return fail(file.string() + ": " + clock.error().message);
  RecordedSets sets(std::move(*states), *clock);
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    Camera& camera = sets.cameras_.emplace_back();
    camera.policy = policies[k];
    if (!has_camera(sets.states_.reader().summary(), cameras[k])) continue;
    auto opened = recording::CameraRecording::open(file, cameras[k]);
    if (!opened) return tl::unexpected(opened.error());
    const hal::StreamFormat& format = opened->index().format;
    camera.pool.emplace(hal::make_frame_pool(format.format, format.width, format.height, kBuffers));
    camera.pictures.emplace(std::move(*opened));
  }
  return sets;
}

std::vector<hal::StreamFormat> RecordedSets::formats() const {
  std::vector<hal::StreamFormat> formats;
  for (const Camera& camera : cameras_) {
    formats.push_back(camera.pictures ? camera.pictures->index().format : hal::StreamFormat{});
  }
  return formats;
}

std::vector<std::optional<int>> RecordedSets::jpeg_qualities() const {
  std::vector<std::optional<int>> qualities;
  for (const Camera& camera : cameras_) {
    const auto* const channels = camera.pictures ? &camera.pictures->index().channels : nullptr;
    const bool is_jpeg = channels != nullptr && channels->is_jpeg;
    qualities.push_back(is_jpeg ? recording::jpeg_quality_in(channels->pictures.metadata)
                                : std::nullopt);
  }
  return qualities;
}

/// The next state, without frames.
Result<std::optional<RecordedSet>> RecordedSets::next_state() {
  auto recorded = states_.next();
  if (!recorded) return tl::unexpected(recorded.error());
  if (!*recorded) return std::nullopt;
  RecordedSet set;
  set.utc = (*recorded)->utc;
  if (set.utc < newest_) {
    return fail(states_.file().string() + ": state " + std::to_string(states_.count() - 1) +
                ": its stamp is before that of the state before");
  }
  newest_ = set.utc;
  set.computed = clock_.to_moment((*recorded)->computed);
  set.state = std::move((*recorded)->state);
  return set;
}

Result<std::optional<RecordedSet>> RecordedSets::next() {
  while (true) {
    auto set = next_state();
    if (!set || !*set) return set;
    const auto has_frames = add_frames(**set);
    if (!has_frames) return tl::unexpected(has_frames.error());
    if (*has_frames) return set;
    ++without_pictures_;
  }
}

/// False: no camera has a picture of this set.
Result<bool> RecordedSets::add_frames(RecordedSet& set) {
  set.frames.id = set.state.frame_set;
  set.frames.stamp = clock_.to_moment(set.utc);
  if (set.state.trigger != 0) set.frames.trigger = set.state.trigger;
  bool has_frames = false;
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    const auto is_new = add_frame(k, set);
    if (!is_new) return is_new;
    has_frames = has_frames || *is_new;
  }
  return has_frames;
}

/// True: the camera's frame is of this set; false: none, or a held one.
Result<bool> RecordedSets::add_frame(std::size_t number, RecordedSet& set) {
  Camera& camera = cameras_[number];
  if (!camera.pictures) return false;
  const auto& exposures = camera.pictures->index().exposures;
  while (camera.next < exposures.size() && exposures[camera.next].set_time < set.utc) ++camera.next;
  const bool is_new = camera.next < exposures.size() && exposures[camera.next].set_time == set.utc;
  if (!is_new) {
    set.frames.held[number] = camera.newest && camera.policy == hal::SyncPolicy::Hold;
    if (set.frames.held[number]) set.frames.frames[number] = camera.newest;
    return false;
  }
  const recording::RecordedExposure& exposure = exposures[camera.next];
  auto buffer = camera.pool->acquire();
  if (!buffer) return fail("the frames of the set before are in use");
  const hal::StreamFormat& format = camera.pictures->index().format;
  const auto target = MutablePicture::contiguous(format.format, format.width, format.height,
                                                 buffer->memory, buffer->picture.planes[0].stride);
  const auto status = camera.pictures->read(camera.next++, target);
  if (!status) return tl::unexpected(status.error());
  buffer->picture.colour_space = format.colour_space;
  buffer->metadata = {.sequence = exposure.sequence,
                      .exposure_start = clock_.to_moment(exposure.start),
                      .trigger = set.frames.trigger,
                      .status = *status};
  set.frames.frames[number] = camera.newest = std::move(buffer);
  return true;
}

}  // namespace orbwatch::app::daemon
