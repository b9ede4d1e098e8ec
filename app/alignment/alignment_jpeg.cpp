// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_jpeg.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "app/pictures/jpeg_encoder.h"
#include "app/pictures/picture_conversion.h"
#include "app/pipeline/views/still_view.h"

namespace orbwatch::app {
namespace {

constexpr int kQuality = 90;
/// Share of the pixels that may be black or white; a lamp or a melt pool takes no more.
constexpr double kClipped = 0.005;

/// The upper and lower ends of what is there.
std::pair<double, double> range_of(std::vector<std::uint16_t> sorted) {
  const auto clipped = static_cast<std::ptrdiff_t>(kClipped * static_cast<double>(sorted.size()));
  std::ranges::nth_element(sorted, sorted.begin() + clipped);
  const double low = sorted[static_cast<std::size_t>(clipped)];
  std::ranges::nth_element(sorted, sorted.end() - 1 - clipped);
  const double high = *(sorted.end() - 1 - clipped);
  return {low, std::max(high, low + 1)};
}

/// 8 bit samples, row by row.
std::vector<std::uint8_t> stretched(const Picture& picture) {
  const std::ptrdiff_t pixels = std::ptrdiff_t(picture.width) * picture.height;
  std::vector<std::uint16_t> counts(static_cast<std::size_t>(pixels));
  convert(picture, PixelFormat::Y16, reinterpret_cast<std::byte*>(counts.data()));
  const auto [low, high] = range_of(counts);
  std::vector<std::uint8_t> grey(counts.size());
  for (std::size_t n = 0; n < grey.size(); ++n) {
    const double share = (counts[n] - low) / (high - low);
    grey[n] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
  }
  return grey;
}

Result<std::string> encoded(const Picture& picture) {
  JpegEncoder encoder;
  return encoder.encode(picture, kQuality).map([](std::span<std::uint8_t> jpeg) {
    return std::string(jpeg.begin(), jpeg.end());
  });
}

Result<std::string> shown(const Picture& picture, const optics::BallProjection& ball,
                          const std::optional<optics::ViewSpec>& view) {
  if (!view) return encoded(picture);
  if (picture.format != PixelFormat::Grey && !remap::can_remap(picture.format, PixelFormat::Rgb)) {
    return fail("pictures of format " + std::string(info(picture.format).name) +
                " are not turned into views");
  }
  const bool is_grey = picture.format == PixelFormat::Grey;
  return optics::ViewProjection::make(*view, ball).and_then([&](optics::ViewProjection projection) {
    const pipeline::StillPlan plan{std::move(projection),
                                   is_grey ? PixelFormat::Grey : PixelFormat::Rgb};
    const pipeline::StillSource source{picture, ball};
    return encoded(render_once(plan, {&source, 1}).picture);
  });
}

}  // namespace

Result<std::string> alignment_jpeg(const Picture& picture, const optics::BallProjection& ball,
                                   const std::optional<optics::ViewSpec>& view) {
  const PixelFormatInfo& facts = info(picture.format);
  if (facts.colour == ColourModel::Luminance && facts.bits > 8) {
    std::vector<std::uint8_t> grey = stretched(picture);
    const ImageView<std::uint8_t> samples{grey.data(), picture.width, picture.height, 1,
                                          picture.width};
    return shown(picture_of(PixelFormat::Grey, samples), ball, view);
  }
  return shown(picture, ball, view);
}

}  // namespace orbwatch::app
