// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/pictures/picture_writer.h"

#include "app/pictures/picture_conversion.h"
#include "app/ports/dds/participant/participant.h"

namespace orbwatch::app::dds {
namespace {

/// Limit of the pixels, beside the rest of an image message.
constexpr std::size_t kMaxPixelBytes = kMaxSampleBytes - 4096;

// The C API takes non-const pointers, but a write changes nothing.
template <class To, class From>
To* writable(const From* data) {
  return reinterpret_cast<To*>(const_cast<From*>(data));
}

}  // namespace

void RawPictureWriter::write(StampedPicture stamped, TopicWriter& topic) {
  const Picture& picture = stamped.picture;
  const bool counts = converts(picture.format, PixelFormat::Y16);
  const PixelFormat format = counts ? PixelFormat::Y16 : encoding_;
  const ImageEncoding& encoding = encoding_of(format);
  const int step = row_bytes(format, picture.width);
  const std::size_t size = packed_bytes(format, picture.width, picture.height);
  if (size > kMaxPixelBytes) {
    topic.count_failure("picture of " + std::to_string(size) + " bytes, DDS carries at most " +
                        std::to_string(kMaxPixelBytes));
    return;
  }
  const std::byte* pixels = picture.planes[0].data;
  const bool is_grey_plane = format == PixelFormat::Grey &&
                             // the first plane is luminance
                             info(picture.format).plane_count() > 1;
  const bool is_as_sent =
      (picture.format == format || counts || is_grey_plane) && picture.planes[0].stride == step;
  if (stamped.is_scarce || !is_as_sent) {
    converted_.resize(size);
    convert(picture, format, converted_.data());
    pixels = converted_.data();
    stamped.owner.reset();
  }
  ImageMessage message{};
  message.header.stamp = stamped.stamp;
  message.header.frame_id = writable<char>(stamped.frame_id->c_str());
  message.height = static_cast<std::uint32_t>(picture.height);
  message.width = static_cast<std::uint32_t>(picture.width);
  message.encoding = writable<char>(encoding.name.data());
  message.is_bigendian = kBigEndianHost ? 1 : 0;
  message.step = static_cast<std::uint32_t>(step);
  const auto length = static_cast<std::uint32_t>(size);
  message.data = {length, length, writable<std::uint8_t>(pixels), false};
  topic.write(&message);
  if (stamped.also) stamped.also->write(&message);
}

void JpegPictureWriter::write(StampedPicture stamped, TopicWriter& topic) {
  const auto jpeg = encoder_.encode(stamped.picture, quality_);
  if (!jpeg) {
    topic.count_failure(jpeg.error().message);
    return;
  }
  stamped.owner.reset();
  CompressedImageMessage message{};
  message.header.stamp = stamped.stamp;
  message.header.frame_id = writable<char>(stamped.frame_id->c_str());
  const bool grey = info(stamped.picture.format).colour == ColourModel::Luminance;
  message.format = writable<char>((grey ? kGreyJpeg : kColourJpeg).data());
  const auto length = static_cast<std::uint32_t>(jpeg->size());
  message.data = {length, length, jpeg->data(), false};
  topic.write(&message);
  if (stamped.also) stamped.also->write(&message);
}

}  // namespace orbwatch::app::dds
