// SPDX-License-Identifier: Apache-2.0
#include <zlib.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "hal/jpeg/jpeg_decoder.h"
#include "hal/png/png_decoder.h"
#include "hal/replay/picture_decoder.h"
#include "tests/fuzz/fenced_picture.h"
#include "tests/fuzz/stop.h"

/// Any bytes as a camera's JPEG frame and as a picture to replay: the decoders of a frame agree on
/// damaged ones, and no byte beside the frame is accessed.
namespace orbwatch::fuzz {
namespace {

using Bytes = std::vector<std::byte>;

/// Larger pictures take longer than an input may.
constexpr int kLongestSide = 256;

bool is_small(hal::JpegSize size) { return std::max(size.width, size.height) <= kLongestSide; }

/// Nv12 needs whole pairs of pixels.
bool has_pairs(hal::JpegSize size) { return size.width % 2 == 0 && size.height % 2 == 0; }

bool is_damaged(const Result<>& decoded) {
  return !decoded && decoded.error().message.starts_with("damaged");
}

void decode_as_frame(const Bytes& jpeg) {
  hal::JpegDecoder decoder;
  const auto size = decoder.read_size(jpeg);
  if (!size || !is_small(*size)) return;
  const Result<> checked = decoder.check(jpeg);
  const bool flawed = decoder.is_flawed();
  FencedPicture grey(PixelFormat::Grey, size->width, size->height, 1);
  grey.forbid_padding();
  const Result<> decoded = decoder.decode_packed(jpeg, grey.picture.samples<std::uint8_t>());
  require(decoded.has_value() == checked.has_value(), "check and luminance disagree");
  require(!decoded || decoder.is_flawed() == flawed, "flawed once and not twice");
  if (!has_pairs(*size)) return;
  FencedPicture nv12(PixelFormat::Nv12, size->width, size->height, 1);
  nv12.forbid_padding();
  const Result<> in_colour = decoder.decode_nv12(jpeg, nv12.picture);
  require(!in_colour || checked, "damaged luminance in a good frame");
  require(!checked || !is_damaged(in_colour), "a good picture is damaged as a frame");
}

/// Sets the right checksum of each chunk, which chance would hardly find.
Bytes with_right_checksums(Bytes png) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kWord = 4;
  const auto word = [&](std::size_t at) { return std::span(png).subspan(at, kWord); };
  for (std::size_t at = kSignature; at + 3 * kWord <= png.size();) {
    std::size_t length = 0;
    for (const std::byte byte : word(at)) length = length << 8 | std::to_integer<unsigned>(byte);
    if (length > png.size() - at - 3 * kWord) break;
    const auto* const typed = reinterpret_cast<const Bytef*>(png.data() + at + kWord);
    auto sum = crc32(0, typed, static_cast<uInt>(length + kWord));
    const auto stated = word(at + 2 * kWord + length);
    for (auto byte = stated.rbegin(); byte != stated.rend(); ++byte, sum >>= 8) {
      *byte = static_cast<std::byte>(sum & 0xff);
    }
    at += 3 * kWord + length;
  }
  return png;
}

bool is_small_png(const Bytes& file) {
  hal::PngDecoder decoder;
  const auto header = decoder.open(file);
  return header && std::max(header->width, header->height) <= kLongestSide;
}

void replay(const Bytes& file) {
  const bool is_png = hal::is_png(file);
  if (is_png && !is_small_png(file)) return;
  if (const auto size = hal::JpegDecoder().read_size(file); size && !is_small(*size)) return;
  const auto decoded = hal::decode_picture(file, "input");
  if (!decoded) {
    require(!decoded.error().message.empty(), "refused without a reason");
    return;
  }
  const Picture& picture = decoded->picture;
  require(picture.width > 0 && picture.height > 0 && decoded->storage, "a picture without pixels");
  require(!is_png || !decoded->is_flawed, "a flaw of JPEG in a PNG picture");
}

void run(std::span<const std::uint8_t> input) {
  const auto bytes = std::as_bytes(input);
  const Bytes file(bytes.begin(), bytes.end());
  decode_as_frame(file);
  replay(hal::is_png(file) ? with_right_checksums(file) : file);
}

}  // namespace
}  // namespace orbwatch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  orbwatch::fuzz::run({data, size});
  return 0;
}
