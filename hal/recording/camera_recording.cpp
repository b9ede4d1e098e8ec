// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/camera_recording.h"

#include <string>

namespace orbwatch::hal::recording {

Result<CameraRecording> CameraRecording::open(const std::filesystem::path& file,
                                              std::string_view camera) {
  auto reader = mcap::Reader::open(file);
  if (!reader) return fail(reader.error().message);
  auto index = index_camera(*reader, camera);
  if (!index) return fail(file.string() + ": " + index.error().message);
  return CameraRecording(file, std::move(*reader),
                         std::make_shared<const CameraIndex>(std::move(*index)));
}

Result<CameraRecording> CameraRecording::open(const std::filesystem::path& file,
                                              std::shared_ptr<const CameraIndex> index) {
  auto reader = mcap::Reader::open_finished(file);
  if (!reader) return fail(reader.error().message);
  return CameraRecording(file, std::move(*reader), std::move(index));
}

/// Loads the message of the exposure.
Result<mcap::Message> CameraRecording::load(const RecordedExposure& exposure) {
  constexpr const char* kChanged = "the recording has changed since it was read first";
  if (exposure.chunk >= reader_.summary().chunks.size()) return fail(kChanged);
  if (exposure.chunk != chunk_ || exposure.message < next_) {
    chunk_ = static_cast<std::size_t>(-1);
    if (const auto loaded = reader_.load_chunk(exposure.chunk); !loaded) {
      return fail(loaded.error().message);
    }
    chunk_ = exposure.chunk;
    next_ = 0;
  }
  while (auto message = reader_.next()) {
    if (next_++ == exposure.message) return *message;
  }
  return fail(kChanged);
}

Error CameraRecording::named(std::size_t exposure, const Error& error) const {
  return {file_.string() + ": " + index_->channels.pictures.topic + ", picture " +
          std::to_string(exposure) + ": " + error.message};
}

Result<RecordedPart> CameraRecording::part(std::size_t exposure) {
  const RecordedExposure& place = index_->exposures.at(exposure);
  const StreamFormat& whole = index_->format;
  return load(place)
      .and_then([&](const mcap::Message& message) {
        return part_in(message, index_->channels, whole.format);
      })
      .and_then([&](RecordedPart part) -> Result<RecordedPart> {
        const PicturePlace in_whole{whole.width, whole.height, place.region};
        const auto fits = check_fit(part.format, part.width, part.height, in_whole, whole.format);
        if (!fits) return tl::unexpected(fits.error());
        return part;
      })
      .map_error([&](const Error& error) { return named(exposure, error); });
}

Result<FrameStatus> CameraRecording::read(std::size_t exposure, const MutablePicture& target) {
  const auto recorded = part(exposure);
  if (!recorded) return tl::unexpected(recorded.error());
  blacken(target);
  return place_part(*recorded, index_->exposures[exposure].region, *jpeg_, target)
      .map_error([&](const Error& error) { return named(exposure, error); });
}

}  // namespace orbwatch::hal::recording
