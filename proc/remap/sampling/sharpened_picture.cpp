// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/sharpened_picture.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "proc/remap/sampling/plane_sampling.h"

namespace orbwatch::remap {
namespace {

const std::uint8_t* bytes(const std::byte* data) {
  return reinterpret_cast<const std::uint8_t*>(data);
}

/// Gains that sharpen only the luminance of packed YUV.
SharpeningGains gains_of(PixelFormat format, double sharpness) {
  const std::int16_t gain = sharpening_gain(sharpness);
  const PlaneSampling luminance = samplings(format).items[0];
  if (luminance.layout != Layout::FirstOfTwo8) return {gain, gain};
  return luminance.offset == 0 ? SharpeningGains{gain, 0} : SharpeningGains{0, gain};
}

}  // namespace

SharpenedPicture::SharpenedPicture(PixelFormat format, int width, int height, double sharpness)
    : gains_(gains_of(format, sharpness)),
      memory_(static_cast<std::size_t>(row_bytes(format, width)) * height) {
  assert(can_sharpen(format));
  picture_ = {format, {}, width, height, {}};
}

void SharpenedPicture::set_source(const Picture& source) {
  assert(source.format == picture_.format);
  assert(source.width == picture_.width && source.height == picture_.height);
  source_ = source;
  picture_ = source;
  picture_.planes[0] = {memory_.data(), row_bytes(source.format, source.width)};
}

void SharpenedPicture::fill(const SourceArea& area) {
  const auto& from = source_.planes[0];
  const int channels = info(source_.format).channels();
  // Pixels of packed YUV that share chroma have their luminance two samples apart.
  const int pair = gains_[0] == gains_[1] ? 1 : 2;
  const int first = area.left / pair * pair, last = (area.right + pair - 1) / pair * pair;
  const auto row = [&](int y) {
    return bytes(from.data) + std::clamp(y, 0, source_.height - 1) * from.stride;
  };
  auto* out = reinterpret_cast<std::uint8_t*>(memory_.data());
  const std::ptrdiff_t stride = picture_.planes[0].stride;
  for (int y = area.top; y < area.bottom; ++y) {
    sharpen_row({row(y - 1), row(y), row(y + 1), source_.width * channels, channels}, gains_,
                first * channels, last * channels, out + y * stride);
  }
}

}  // namespace orbwatch::remap
