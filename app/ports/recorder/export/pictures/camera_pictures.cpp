// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/pictures/camera_pictures.h"

#include <algorithm>

#include "hal/recording/camera_channels.h"
#include "hal/recording/recorded_part.h"

namespace orbwatch::app::recorder {
namespace {

using hal::recording::RecordedExposure;

/// The camera that is meant.
Result<std::string> camera_in(const std::filesystem::path& recording, const std::string& stated) {
  const auto reader = hal::mcap::Reader::open(recording);
  if (!reader) return fail(reader.error().message);
  const auto cameras = hal::recording::cameras_in(reader->summary());
  if (stated.empty() && cameras.size() == 1) return cameras.front();
  if (std::ranges::find(cameras, stated) != cameras.end()) return stated;
  std::string names;
  for (const std::string& camera : cameras) names.append(names.empty() ? "" : ", ").append(camera);
  if (names.empty()) return fail(recording.string() + ": no pictures");
  return fail((stated.empty() ? "a camera must be chosen" : "there is no camera " + stated) +
              "; the recording has pictures of " + names);
}

}  // namespace

Result<CameraPictures> CameraPictures::open(const std::filesystem::path& recording,
                                            const std::string& camera, const StampRange& range) {
  auto name = camera_in(recording, camera);
  if (!name) return tl::unexpected(name.error());
  auto pictures = hal::recording::CameraRecording::open(recording, *name);
  if (!pictures) return tl::unexpected(pictures.error());
  auto states = RecordedStates::open(recording);
  if (!states) return tl::unexpected(states.error());
  CameraPictures opened(recording, *name, std::move(*pictures), std::move(*states));
  const auto& exposures = opened.index().exposures;
  const auto begin =
      std::ranges::lower_bound(exposures, range.first, {}, &RecordedExposure::set_time);
  const auto end = std::ranges::upper_bound(exposures, range.last, {}, &RecordedExposure::set_time);
  if (begin >= end) {
    return fail(recording.string() + ": no picture of " + opened.camera() + " in this range");
  }
  opened.begin_ = opened.next_ = static_cast<std::size_t>(begin - exposures.begin());
  opened.end_ = static_cast<std::size_t>(end - exposures.begin());
  return opened;
}

Result<> CameraPictures::rewind() {
  auto states = RecordedStates::open(file_);
  if (!states) return tl::unexpected(states.error());
  states_ = std::move(*states);
  state_.reset();
  next_ = begin_;
  return {};
}

Result<const ProcessState*> CameraPictures::state_at(std::uint64_t stamp) {
  while (!state_ || state_->utc < stamp) {
    auto state = states_.next();
    if (!state) return tl::unexpected(state.error());
    if (!*state) return nullptr;
    state_ = std::move(*state);
  }
  return state_->utc == stamp ? &state_->state : nullptr;
}

Result<ExportedPicture> CameraPictures::next() {
  const RecordedExposure& exposure = index().exposures.at(next_);
  const auto state = state_at(exposure.set_time);
  if (!state) return tl::unexpected(state.error());
  auto part = pictures_.part(next_++);
  if (!part) return tl::unexpected(part.error());
  return ExportedPicture{exposure, std::move(*part), *state};
}

Result<Picture> CameraPictures::pixels(const ExportedPicture& picture) {
  return hal::recording::pixels_of(picture.part, index().format.colour_space, *decoder_, pixels_)
      .map_error([&](const Error& error) {
        return Error{file_.string() + ": " + camera_ + ": " + error.message};
      });
}

}  // namespace orbwatch::app::recorder
