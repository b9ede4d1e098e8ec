// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_file.h"

#include <algorithm>
#include <cerrno>
#include <string>
#include <utility>

#include "hal/mcap/cdr.h"
#include "hal/recording/camera_stream.h"
#include "hal/recording/image.h"
#include "hal/recording/topics.h"
#include "proc/optics/named_distortion.h"

namespace orbwatch::app::recorder {
namespace {

namespace recording = hal::recording;
using hal::mcap::FileResult;

constexpr std::string_view kPrefix = "orbwatch";
/// Level of zstd: the fastest, for pixels.
constexpr int kPictureLevel = 1;

/// Adds the calibration of the whole picture.
void add_lens(recording::CameraInfo& message, const optics::Intrinsics& lens) {
  const auto [model, count] = optics::named_distortion(lens);
  message.distortion_model = model;
  message.d.assign(lens.coefficients.begin(), lens.coefficients.begin() + static_cast<long>(count));
  message.k = {lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1};
  message.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  message.p = {lens.fx, 0, lens.cx, 0, 0, lens.fy, lens.cy, 0, 0, 0, 1, 0};
}

/// Replaces the stamp of a message that begins with a header.
void set_stamp(hal::mcap::Bytes& message, std::uint64_t stamp) {
  const recording::Header header = recording::header_at(stamp, {});
  hal::mcap::Bytes encoded;
  hal::mcap::encode_cdr(header, encoded);
  const std::size_t size =
      hal::mcap::kCdrLittleEndian.size() + sizeof header.sec + sizeof header.nanosec;
  std::copy_n(encoded.begin(), size, message.begin());
}

}  // namespace

FileResult<EventFile> EventFile::create(const std::filesystem::path& path,
                                        const RecordedTexts& texts, const EventSettings& settings,
                                        const std::vector<RecordedCamera>& cameras,
                                        hal::TimePoint moment, Utc utc) {
  auto log = LogFile::create(path, texts, utc, kPictureLevel);
  if (!log) return hal::mcap::error_of(log);
  const auto clock = recording::RecordedClock::when(moment, nanoseconds(utc));
  if (auto added = log->add_metadata(clock.metadata()); !added) {
    return tl::unexpected(added.error());
  }
  return EventFile(std::move(*log), settings, cameras, clock);
}

FileResult<> EventFile::write(const LogMessage& message) {
  LogMessage stamped = message;
  stamped.utc = utc(message.stamp);
  set_stamp(stamped.bytes, nanoseconds(stamped.utc));
  return log_.write(stamped);
}

/// True: pixels are written, not JPEG.
bool EventFile::is_raw(const KeptFrame& frame) const {
  if (!frame.jpeg.empty()) return false;
  return settings_->lossless || info(frame.picture.format).bytes_per_sample() > 1;
}

/// The channels of a camera begin with its first picture, whose format is known.
FileResult<> EventFile::add_camera(const KeptFrame& frame) {
  const RecordedCamera& camera = (*cameras_)[frame.camera];
  hal::StreamFormat format = camera.format;
  format.format = frame.picture.format;
  format.colour_space = frame.picture.colour_space;
  format.kelvin_per_count = frame.kelvin_per_count;
  format.kelvin_offset = frame.kelvin_offset;
  Channels channels;
  channels.is_raw = is_raw(frame);
  channels.kelvin_per_count = frame.kelvin_per_count;
  auto metadata = recording::metadata_of(format);
  if (!channels.is_raw && frame.jpeg.empty()) {
    metadata.emplace_back(recording::kJpegQuality, std::to_string(settings_->quality));
  }
  const auto added =
      log_.add_topic(channels.is_raw ? recording::image_topic(kPrefix, camera.name)
                                     : recording::compressed_topic(kPrefix, camera.name),
                     channels.is_raw ? recording::Image::kType : recording::CompressedImage::kType,
                     metadata)
          .and_then([&](std::uint16_t channel) {
            channels.pictures = channel;
            return log_.add_topic(recording::camera_info_topic(kPrefix, camera.name),
                                  recording::CameraInfo::kType);
          })
          .map([&](std::uint16_t channel) { channels.places = channel; });
  if (added) channels_[frame.camera] = channels;
  return added;
}

void EventFile::encode_jpeg(std::span<const std::byte> jpeg, std::string_view format,
                            const recording::Header& header) {
  recording::CompressedImage message;
  message.header = header;
  message.format = format;
  message.data = jpeg;
  hal::mcap::encode_cdr(message, message_);
}

/// Puts the picture's message into message_.
FileResult<> EventFile::encode(const KeptFrame& frame, const recording::Header& header) {
  const Picture& picture = frame.picture;
  if (!frame.jpeg.empty()) {
    encode_jpeg(frame.jpeg, recording::kReceivedJpeg, header);
    return {};
  }
  if (is_raw(frame)) {
    hal::mcap::encode_cdr(recording::image_of(picture, header, pixels_), message_);
    return {};
  }
  const auto jpeg = jpeg_.encode(picture, settings_->quality);
  if (!jpeg) return tl::unexpected(hal::mcap::FileError{ENOMEM, jpeg.error().message});
  const bool is_grey = info(picture.format).colour == ColourModel::Luminance;
  encode_jpeg(std::as_bytes(*jpeg), is_grey ? recording::kGreyJpeg : recording::kColourJpeg,
              header);
  return {};
}

FileResult<bool> EventFile::write(const KeptFrame& frame) {
  if (!channels_[frame.camera]) {
    if (auto added = add_camera(frame); !added) return hal::mcap::error_of(added);
  }
  const Channels& channels = *channels_[frame.camera];
  if (channels.is_raw != is_raw(frame)) return false;
  if (channels.kelvin_per_count != frame.kelvin_per_count) return false;
  const RecordedCamera& camera = (*cameras_)[frame.camera];
  const std::uint64_t stamp = nanoseconds(utc(frame.stamp));
  const auto header = recording::header_at(stamp, camera.name);
  hal::mcap::MessageHead head{channels.places, static_cast<std::uint32_t>(frame.sequence),
                              nanoseconds(utc(frame.set_stamp)), stamp};
  auto place = recording::camera_info_of(frame.place, header);
  if (camera.lens) add_lens(place, *camera.lens);
  hal::mcap::encode_cdr(place, message_);
  if (auto written = log_.write(head, message_); !written) return hal::mcap::error_of(written);
  head.channel_id = channels.pictures;
  auto written = encode(frame, header).and_then([&] { return log_.write(head, message_); });
  if (!written) return hal::mcap::error_of(written);
  ++pictures_[frame.camera];
  return true;
}

FileResult<> EventFile::finish() {
  return log_.flush().and_then([this] { return log_.finish(); });
}

}  // namespace orbwatch::app::recorder
