// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/image.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <utility>

#include "hal/recording/picture_region.h"

namespace orbwatch::hal::recording {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are stored as in memory");

struct Encoding {
  std::string_view name;
  PixelFormat format;
};

/// The first one of a format is written; all are read.
constexpr std::array kEncodings{
    Encoding{"mono8", PixelFormat::Grey},       Encoding{"mono16", PixelFormat::Y16},
    Encoding{"mono16", PixelFormat::Y10},       Encoding{"mono16", PixelFormat::Y12},
    Encoding{"yuv422_yuy2", PixelFormat::Yuyv}, Encoding{"yuv422", PixelFormat::Uyvy},
    Encoding{"nv12", PixelFormat::Nv12},        Encoding{"nv21", PixelFormat::Nv21},
    Encoding{"i420", PixelFormat::I420},        Encoding{"rgb8", PixelFormat::Rgb},
    Encoding{"bgr8", PixelFormat::Bgr},         Encoding{"bgra8", PixelFormat::Bgra},
    Encoding{"rgb16", PixelFormat::Rgb16},      Encoding{"8UC1", PixelFormat::Grey},
    Encoding{"16UC1", PixelFormat::Y16},        Encoding{"yuyv", PixelFormat::Yuyv},
    Encoding{"uyvy", PixelFormat::Uyvy}};

std::string known_encodings() {
  std::string names;
  std::string_view last;
  for (const Encoding& encoding : kEncodings) {
    if (encoding.name == last) continue;
    names.append(last.empty() ? "" : ", ").append(encoding.name);
    last = encoding.name;
  }
  return names;
}

/// The encoding is left out, as it may be any text.
std::string named(const Image& message) {
  return "image of " + std::to_string(message.width) + "x" + std::to_string(message.height) + ": ";
}

/// Error of a message whose sides, step and bytes are no picture of this format.
Result<> check(const Image& message, PixelFormat format) {
  const auto is_side = [](std::uint32_t side) {
    return side >= 1 && side <= std::uint32_t{kMaxSide};
  };
  if (!is_side(message.width) || !is_side(message.height)) {
    return fail(named(message) + "its sides must be 1 to " + std::to_string(kMaxSide));
  }
  const PictureRegion whole{0, 0, static_cast<int>(message.width),
                            static_cast<int>(message.height)};
  if (widened(whole, format) != whole) {
    return fail(named(message) + "its sides must be even where pixels share chroma");
  }
  const int sample = info(format).bytes_per_sample();
  if (sample > 1 && message.is_bigendian != 0) {
    return fail(named(message) + "big-endian; samples must be little-endian");
  }
  const auto row = static_cast<std::uint32_t>(row_bytes(format, whole.width));
  const std::uint32_t unit =
      info(format).plane_count() > 1 ? 2 : static_cast<std::uint32_t>(sample);
  constexpr std::uint32_t kLongestStep = 16 * kMaxSide;
  if (message.step < row || message.step > kLongestStep || message.step % unit != 0) {
    return fail(named(message) + "step of " + std::to_string(message.step) + " bytes; it must be " +
                std::to_string(row) + " to " + std::to_string(kLongestStep) +
                " and a multiple of " + std::to_string(unit));
  }
  const std::size_t bytes = picture_bytes(format, message.step, whole.height);
  if (message.data.size() == bytes) return {};
  return fail(named(message) + std::to_string(message.data.size()) +
              " bytes of pixels; with a step of " + std::to_string(message.step) +
              " there must be " + std::to_string(bytes));
}

}  // namespace

std::string_view encoding_of(PixelFormat format) {
  return std::ranges::find(kEncodings, format, &Encoding::format)->name;
}

Image image_of(const Picture& part, Header header, mcap::Bytes& pixels) {
  const int step = row_bytes(part.format, part.width);
  Image message;
  message.header = std::move(header);
  message.width = static_cast<std::uint32_t>(part.width);
  message.height = static_cast<std::uint32_t>(part.height);
  message.encoding = encoding_of(part.format);
  message.step = static_cast<std::uint32_t>(step);
  mcap::resized(pixels, picture_bytes(part.format, static_cast<std::size_t>(step), part.height));
  const auto packed =
      MutablePicture::contiguous(part.format, part.width, part.height, pixels.data(), step);
  copy_pixels(part, packed);
  message.data = pixels;
  return message;
}

Result<Picture> picture_of(const Image& message, PixelFormat grey16) {
  const auto* const encoding = std::ranges::find(kEncodings, message.encoding, &Encoding::name);
  if (encoding == kEncodings.end()) {
    return fail(named(message) + "unknown encoding; it must be one of " + known_encodings());
  }
  const PixelFormat format = encoding->format == PixelFormat::Y16 ? grey16 : encoding->format;
  if (auto checked = check(message, format); !checked) return tl::unexpected(checked.error());
  return Picture::contiguous(format, static_cast<int>(message.width),
                             static_cast<int>(message.height), message.data.data(),
                             static_cast<std::ptrdiff_t>(message.step));
}

}  // namespace orbwatch::hal::recording
