// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "app/ports/recorder/events/event_summary.h"
#include "hal/mcap/cdr.h"
#include "hal/recording/camera_stream.h"
#include "hal/recording/image.h"
#include "hal/recording/recorded_part.h"
#include "tests/fuzz/byte_stream.h"
#include "tests/fuzz/fenced_picture.h"
#include "tests/fuzz/stop.h"

/// Any bytes as the messages of a picture in a recording, and as the summary of an event. Each is
/// refused in one line, or has one meaning: writing what was read and reading that again changes
/// nothing. A picture has its message's pixels at its place, and no byte beside both is accessed.
///
/// An input is a byte that chooses: a text is the summary; or a byte that chooses the format that
/// the channel states, the size of a CameraInfo as two bytes, that message, and the picture's.
namespace orbwatch::fuzz {
namespace {

using namespace hal::recording;
using Bytes = std::vector<std::byte>;

/// Larger whole pictures take longer than an input may.
constexpr int kLongestSide = 256;

void require_one_line(const Error& error) {
  require(!error.message.empty(), "no reason");
  require(std::ranges::none_of(error.message, [](unsigned char c) { return std::iscntrl(c) != 0; }),
          "refused in more than a line");
}

/// A copy that ends with its last byte, for AddressSanitizer.
Bytes bytes_of(std::span<const std::uint8_t> input) {
  const auto bytes = std::as_bytes(input);
  return {bytes.begin(), bytes.end()};
}

/// Decodes a message; what is written from it must be read as the same. False: refused.
template <class Message>
bool decode(const Bytes& bytes, Message& message) {
  if (!hal::mcap::decode_cdr(bytes, message)) return false;
  Bytes written, again;
  hal::mcap::encode_cdr(message, written);
  Message read;
  require(hal::mcap::decode_cdr(written, read), "a message that was written is not read");
  hal::mcap::encode_cdr(read, again);
  require(written == again, "a message changes when it is read");
  return true;
}

void require_same_pixels(const Picture& one, const Picture& other) {
  Bytes pixels, others;
  image_of(one, {}, pixels);
  image_of(other, {}, others);
  require(pixels == others, "other pixels than the message has");
}

void place(const RecordedPart& part, const PicturePlace& place, PixelFormat format) {
  FencedPicture whole(format, place.width, place.height, 1);
  whole.forbid_padding();
  hal::JpegDecoder decoder;
  const auto placed = place_part(part, place.region, decoder, whole.picture);
  if (!placed) return require_one_line(placed.error());
  if (part.pixels) require_same_pixels(*part.pixels, part_of(whole.picture, place.region));
}

void read_picture(const Bytes& message, const CameraChannels& channels, const PicturePlace& at) {
  const hal::mcap::Message picture{{}, message};
  const auto format = first_format(picture, channels);
  if (!format) return require_one_line(format.error());
  const auto part = part_in(picture, channels, format->format);
  if (!part) return require_one_line(part.error());
  const auto fits = check_fit(part->format, part->width, part->height, at, format->format);
  if (!fits) return require_one_line(fits.error());
  if (std::max(at.width, at.height) <= kLongestSide) place(*part, at, format->format);
}

void try_picture(ByteStream input, bool is_jpeg) {
  CameraChannels channels;
  channels.is_jpeg = is_jpeg;
  hal::StreamFormat stated;
  const std::size_t format = input.byte();
  if (format < kPixelFormats.size()) {
    stated.format = kPixelFormats[format].format;
    channels.pictures.metadata = metadata_of(stated);
  }
  const std::size_t low = input.byte();
  const Bytes info = bytes_of(input.take(low + 256U * input.byte()));
  const Bytes message = bytes_of(input.take(static_cast<std::size_t>(-1)));
  Image image;
  CompressedImage compressed;
  is_jpeg ? decode(message, compressed) : decode(message, image);
  CameraInfo camera;
  if (!decode(info, camera)) return;
  const auto at = place_of(camera);
  if (!at) return require_one_line(at.error());
  read_picture(message, channels, *at);
}

void try_summary(ByteStream input) {
  const auto bytes = input.take(static_cast<std::size_t>(-1));
  const std::string text(bytes.begin(), bytes.end());
  const auto summary = app::recorder::parse_summary(text);
  if (!summary) return require_one_line(summary.error());
  const std::string written = app::recorder::summary_text(*summary);
  const auto again = app::recorder::parse_summary(written);
  require(again.has_value(), "a summary that was written is not read");
  require(app::recorder::summary_text(*again) == written, "a summary changes when it is read");
}

}  // namespace
}  // namespace orbwatch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  orbwatch::fuzz::ByteStream input({data, size});
  const int kind = input.byte() % 3;
  kind == 2 ? orbwatch::fuzz::try_summary(input) : orbwatch::fuzz::try_picture(input, kind == 1);
  return 0;
}
