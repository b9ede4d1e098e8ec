// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/recorded_part.h"

#include <string>
#include <utility>

#include "hal/mcap/cdr.h"
#include "hal/mcap/limits.h"
#include "hal/recording/camera_stream.h"
#include "hal/recording/image.h"

namespace orbwatch::hal::recording {
namespace {

Result<Image> image_in(const mcap::Message& message) {
  Image image;
  if (mcap::decode_cdr(message.data, image)) return image;
  return fail("not an Image in little-endian CDR, or damaged");
}

Result<CompressedImage> jpeg_in(const mcap::Message& message) {
  CompressedImage image;
  if (!mcap::decode_cdr(message.data, image)) {
    return fail("not a CompressedImage in little-endian CDR, or damaged");
  }
  if (image.format.find("jpeg") != std::string::npos || image.format == "jpg") return image;
  return fail("compressed otherwise; the format must be JPEG, such as \"" +
              std::string(kColourJpeg) + "\"");
}

/// Format that JPEG is decoded to where the camera had `format`.
PixelFormat decoded_format(PixelFormat format) {
  switch (info(format).colour) {
    case ColourModel::Luminance:
      return PixelFormat::Grey;
    case ColourModel::Yuv:
      return PixelFormat::Nv12;
    case ColourModel::Rgb:
      return PixelFormat::Rgb;
  }
  return PixelFormat::Grey;
}

}  // namespace

Result<StreamFormat> first_format(const mcap::Message& message, const CameraChannels& channels) {
  StreamFormat format;
  if (channels.is_jpeg) {
    const auto image = jpeg_in(message);
    if (!image) return tl::unexpected(image.error());
    const auto size = JpegDecoder().read_size(image->data);
    if (!size) return fail("JPEG: " + size.error().message);
    format.format = size->is_grey ? PixelFormat::Grey : PixelFormat::Rgb;
  } else {
    const auto image = image_in(message);
    if (!image) return tl::unexpected(image.error());
    const auto picture = picture_of(*image);
    if (!picture) return tl::unexpected(picture.error());
    format.format = picture->format;
  }
  const PixelFormat present = format.format;
  const auto read = read_metadata(channels.pictures.metadata, format);
  if (!read) return tl::unexpected(read.error());
  if (channels.is_jpeg) {
    format.format = decoded_format(format.format);
    format.colour_space = {ColourMatrix::Bt601, ColourRange::Full};
  } else if (encoding_of(format.format) != encoding_of(present)) {
    return fail("metadata of the channel: pixel_format is " +
                std::string(info(format.format).name) + ", but the picture is " +
                std::string(info(present).name));
  }
  return format;
}

Result<RecordedPart> part_in(const mcap::Message& message, const CameraChannels& channels,
                             PixelFormat format) {
  RecordedPart part;
  if (channels.is_jpeg) {
    auto image = jpeg_in(message);
    if (!image) return tl::unexpected(image.error());
    const auto size = JpegDecoder().read_size(image->data);
    if (!size) return fail("JPEG: " + size.error().message);
    return RecordedPart{
        std::move(image->header), format, size->width, size->height, std::nullopt, image->data};
  }
  auto image = image_in(message);
  if (!image) return tl::unexpected(image.error());
  const bool is_grey16 = encoding_of(format) == encoding_of(PixelFormat::Y16);
  const auto picture = picture_of(*image, is_grey16 ? format : PixelFormat::Y16);
  if (!picture) return tl::unexpected(picture.error());
  return RecordedPart{std::move(image->header), picture->format, picture->width,
                      picture->height,          *picture,        {}};
}

Result<FrameStatus> place_part(const RecordedPart& part, const PictureRegion& region,
                               JpegDecoder& decoder, const MutablePicture& whole) {
  const MutablePicture target = part_of(whole, region);
  if (part.pixels) {
    copy_pixels(*part.pixels, target);
    return FrameStatus::Intact;
  }
  const auto decoded = target.format == PixelFormat::Nv12
                           ? decoder.decode_nv12(part.jpeg, target)
                           : decoder.decode_packed(part.jpeg, target.samples<std::uint8_t>());
  if (!decoded) return fail("JPEG: " + decoded.error().message);
  return decoder.is_flawed() ? FrameStatus::Flawed : FrameStatus::Intact;
}

Result<Picture> pixels_of(const RecordedPart& part, const ColourSpace& colour_space,
                          JpegDecoder& decoder, std::vector<std::byte>& buffer) {
  const int stride = row_bytes(part.format, part.width);
  const std::size_t bytes =
      picture_bytes(part.format, static_cast<std::size_t>(stride), part.height);
  if (bytes > mcap::Limits{}.chunk) {
    return fail("a picture of " + std::to_string(part.width) + "x" + std::to_string(part.height) +
                "; it must be at most 64 MiB large");
  }
  buffer.resize(bytes);
  auto target =
      MutablePicture::contiguous(part.format, part.width, part.height, buffer.data(), stride);
  target.colour_space = colour_space;
  return place_part(part, {0, 0, part.width, part.height}, decoder, target).map([&](FrameStatus) {
    return Picture(target);
  });
}

}  // namespace orbwatch::hal::recording
