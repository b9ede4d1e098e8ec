// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_pictures.h"

#include <utility>

#include "app/ports/recorder/events/trigger_picture.h"
#include "app/ports/recorder/recorded_utc.h"
#include "hal/mcap/reader.h"
#include "hal/recording/camera_channels.h"
#include "hal/recording/picture_region.h"

namespace orbwatch::app::recorder {
namespace {

constexpr int kQuality = 90;

/// Adds the part of the next picture if it differs from that before.
void add_part(const hal::recording::PictureRegion& region, RecordedFrames& frames) {
  const FramePart part{frames.times.size(), region.x, region.y, region.width, region.height};
  const bool is_same = !frames.parts.empty() && frames.parts.back().x == part.x &&
                       frames.parts.back().y == part.y && frames.parts.back().width == part.width &&
                       frames.parts.back().height == part.height;
  if (!is_same) frames.parts.push_back(part);
}

}  // namespace

Result<std::vector<RecordedFrames>> EventPictures::frames(
    const std::filesystem::path& recording) const {
  const auto reader = hal::mcap::Reader::open(recording);
  if (!reader) return fail(reader.error().message);
  std::vector<RecordedFrames> all;
  for (const std::string& camera : hal::recording::cameras_in(reader->summary())) {
    const auto pictures = hal::recording::CameraRecording::open(recording, camera);
    if (!pictures) return tl::unexpected(pictures.error());
    RecordedFrames& frames = all.emplace_back();
    frames.camera = camera;
    for (const auto& exposure : pictures->index().exposures) {
      add_part(exposure.region, frames);
      frames.times.push_back(utc_text_at(exposure.set_time));
    }
  }
  return all;
}

Result<EventPictures::Opened*> EventPictures::open(const std::filesystem::path& recording,
                                                   std::string_view camera) {
  if (!opened_ || opened_->recording != recording || opened_->camera != camera) {
    opened_.reset();
    auto pictures = hal::recording::CameraRecording::open(recording, camera);
    if (!pictures) return tl::unexpected(pictures.error());
    opened_.emplace(Opened{recording, std::string(camera), std::move(*pictures)});
  }
  return &*opened_;
}

Result<std::string> EventPictures::jpeg(const std::filesystem::path& recording,
                                        std::string_view camera, std::size_t frame) {
  const std::lock_guard lock(mutex_);
  const auto opened = open(recording, camera);
  if (!opened) return tl::unexpected(opened.error());
  hal::recording::CameraRecording& pictures = (*opened)->pictures;
  const hal::recording::CameraIndex& index = pictures.index();
  if (frame >= index.exposures.size()) {
    return fail("there is no picture " + std::to_string(frame) + "; 0 to " +
                std::to_string(index.exposures.size() - 1) + " are recorded");
  }
  const hal::StreamFormat& format = index.format;
  const int stride = row_bytes(format.format, format.width);
  whole_.resize(picture_bytes(format.format, static_cast<std::size_t>(stride), format.height));
  auto picture =
      MutablePicture::contiguous(format.format, format.width, format.height, whole_.data(), stride);
  picture.colour_space = format.colour_space;
  if (const auto read = pictures.read(frame, picture); !read) return tl::unexpected(read.error());
  const Picture part = hal::recording::part_of(Picture(picture), index.exposures[frame].region);
  return jpeg_for_people(encoder_, part, kQuality).map([](std::span<const std::uint8_t> jpeg) {
    return std::string(jpeg.begin(), jpeg.end());
  });
}

}  // namespace orbwatch::app::recorder
