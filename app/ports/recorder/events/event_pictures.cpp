// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_pictures.h"

#include <utility>

#include "app/ports/recorder/events/trigger_picture.h"
#include "app/ports/recorder/recorded_utc.h"
#include "hal/mcap/reader.h"
#include "hal/recording/camera_channels.h"
#include "hal/recording/camera_recording.h"
#include "hal/recording/picture_region.h"
#include "hal/recording/recorded_part.h"

namespace orbwatch::app::recorder {
namespace {

using hal::recording::CameraIndex;
using hal::recording::CameraRecording;

constexpr int kQuality = 90;

/// Adds the part of the next picture if it differs from that before.
void add_part(const hal::recording::PictureRegion& region, RecordedFrames& frames) {
  const FramePart part{frames.times.size(), region.x, region.y, region.width, region.height};
  const bool is_same = !frames.parts.empty() && frames.parts.back().x == part.x &&
                       frames.parts.back().y == part.y && frames.parts.back().width == part.width &&
                       frames.parts.back().height == part.height;
  if (!is_same) frames.parts.push_back(part);
}

/// Index of a camera's pictures. Errors: those of index_camera(), with the file.
Result<CameraIndex> index_in(hal::mcap::Reader& reader, const std::filesystem::path& recording,
                             std::string_view camera) {
  return hal::recording::index_camera(reader, camera).map_error([&](const Error& error) {
    return Error{recording.string() + ": " + error.message};
  });
}

}  // namespace

Result<std::vector<RecordedFrames>> EventPictures::frames(
    const std::filesystem::path& recording) const {
  auto reader = hal::mcap::Reader::open_finished(recording);
  if (!reader) return fail(reader.error().message);
  std::vector<RecordedFrames> all;
  for (const std::string& camera : hal::recording::cameras_in(reader->summary())) {
    const auto index = index_in(*reader, recording, camera);
    if (!index) return tl::unexpected(index.error());
    RecordedFrames& frames = all.emplace_back();
    frames.camera = camera;
    for (const auto& exposure : index->exposures) {
      add_part(exposure.region, frames);
      frames.times.push_back(utc_text_at(exposure.set_time));
    }
  }
  return all;
}

Result<std::shared_ptr<const CameraIndex>> EventPictures::index_of(
    const std::filesystem::path& recording, std::string_view camera) {
  if (!indexed_ || indexed_->recording != recording || indexed_->camera != camera) {
    indexed_.reset();
    auto reader = hal::mcap::Reader::open_finished(recording);
    if (!reader) return fail(reader.error().message);
    auto index = index_in(*reader, recording, camera);
    if (!index) return tl::unexpected(index.error());
    indexed_.emplace(Indexed{recording, std::string(camera),
                             std::make_shared<const CameraIndex>(std::move(*index))});
  }
  return indexed_->index;
}

Result<std::string> EventPictures::jpeg(const std::filesystem::path& recording,
                                        std::string_view camera, std::size_t frame) {
  const std::lock_guard lock(mutex_);
  const auto found = index_of(recording, camera);
  if (!found) return tl::unexpected(found.error());
  const CameraIndex& index = **found;
  if (frame >= index.exposures.size()) {
    return fail("there is no picture " + std::to_string(frame) + "; 0 to " +
                std::to_string(index.exposures.size() - 1) + " are recorded");
  }
  auto pictures = CameraRecording::open(recording, *found);
  if (!pictures) return tl::unexpected(pictures.error());
  const auto part = pictures->part(frame);
  if (!part) return tl::unexpected(part.error());
  return hal::recording::pixels_of(*part, index.format.colour_space, decoder_, pixels_)
      .and_then([&](const Picture& shown) { return jpeg_for_people(encoder_, shown, kQuality); })
      .map([](std::span<const std::uint8_t> jpeg) { return std::string(jpeg.begin(), jpeg.end()); })
      .map_error([&](const Error& error) { return pictures->named(frame, error); });
}

}  // namespace orbwatch::app::recorder
