// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/picture_sequence.h"

#include <system_error>

#include "hal/frame/frame_pool.h"
#include "hal/replay/picture_folder.h"

namespace orbwatch::hal {
namespace {

Result<DecodedPicture> decoded(recording::CameraRecording& recording, std::size_t number) {
  const StreamFormat& format = recording.index().format;
  FrameBuffer buffer;
  allocate_picture(buffer, format.format, format.width, format.height);
  const auto target = MutablePicture::contiguous(format.format, format.width, format.height,
                                                 buffer.memory, buffer.picture.planes[0].stride);
  const auto status = recording.read(number, target);
  if (!status) return tl::unexpected(status.error());
  buffer.picture.colour_space = format.colour_space;
  return DecodedPicture{buffer.picture, std::move(buffer.storage), *status == FrameStatus::Flawed};
}

}  // namespace

Result<PictureSequence> PictureSequence::open(const std::filesystem::path& source,
                                              std::string_view camera) {
  std::error_code error;
  const bool is_folder = std::filesystem::is_directory(source, error);
  if (recording::has_recording_name(source) && !is_folder) {
    auto recording = recording::CameraRecording::open(source, camera);
    if (!recording) return tl::unexpected(recording.error());
    return PictureSequence(source, std::move(*recording));
  }
  auto files = pictures_in(source);
  if (!files) return tl::unexpected(files.error());
  return PictureSequence(source, std::move(*files));
}

std::size_t PictureSequence::size() const {
  const auto* const files = std::get_if<Files>(&source_);
  return files != nullptr ? files->size()
                          : std::get<recording::CameraRecording>(source_).index().exposures.size();
}

std::string PictureSequence::name(std::size_t picture) const {
  const auto* const files = std::get_if<Files>(&source_);
  return files != nullptr ? files->at(picture).filename().string()
                          : "picture " + std::to_string(picture);
}

std::string PictureSequence::path(std::size_t picture) const {
  const auto* const files = std::get_if<Files>(&source_);
  return files != nullptr ? files->at(picture).string() : path_.string() + ": " + name(picture);
}

std::optional<std::chrono::nanoseconds> PictureSequence::time(std::size_t picture) const {
  const auto* const recording = std::get_if<recording::CameraRecording>(&source_);
  if (recording == nullptr) return std::nullopt;
  const auto& exposures = recording->index().exposures;
  const std::uint64_t since = exposures.at(picture).start - exposures.front().start;
  return std::chrono::nanoseconds(static_cast<std::int64_t>(since));
}

std::optional<std::uint64_t> PictureSequence::set_time(std::size_t picture) const {
  const auto* const recording = std::get_if<recording::CameraRecording>(&source_);
  if (recording == nullptr) return std::nullopt;
  return recording->index().exposures.at(picture).set_time;
}

Result<DecodedPicture> PictureSequence::read(std::size_t picture) {
  if (auto* const recording = std::get_if<recording::CameraRecording>(&source_)) {
    return decoded(*recording, picture);
  }
  return read_picture(std::get<Files>(source_).at(picture));
}

}  // namespace orbwatch::hal
