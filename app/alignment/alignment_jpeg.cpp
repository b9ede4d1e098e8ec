// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/alignment_jpeg.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "app/pictures/jpeg_encoder.h"
#include "app/pictures/picture_conversion.h"
#include "app/pictures/picture_scaler.h"
#include "app/pipeline/views/still_view.h"

namespace orbwatch::app {
namespace {

constexpr int kQuality = 90;
/// Percentiles of the values that become black and white.
constexpr double kBlack = 0.01, kWhite = 0.99;

using Counts = std::vector<std::uint16_t>;

Result<std::string> encoded(const Picture& picture) {
  JpegEncoder encoder;
  return encoder.encode(picture, kQuality).map([](std::span<std::uint8_t> jpeg) {
    return std::string(jpeg.begin(), jpeg.end());
  });
}

/// A whole picture in the sides that are asked for.
Result<std::string> whole_jpeg(const Picture& picture, const AlignmentPicture& asked) {
  if (asked.width == 0 || asked.width >= picture.width) return encoded(picture);
  const PixelFormat format =
      info(picture.format).colour == ColourModel::Luminance ? PixelFormat::Grey : PixelFormat::Rgb;
  std::vector<std::byte> packed(packed_bytes(format, picture.width, picture.height));
  convert(picture, format, packed.data());
  PictureScaler scaler;
  return encoded(scaler.scaled(Picture::contiguous(format, picture.width, picture.height,
                                                   packed.data(), row_bytes(format, picture.width)),
                               asked.width, asked.height));
}

/// Counts of luminance of any depth, row by row.
Counts counts_of(const Picture& picture) {
  Counts counts(static_cast<std::size_t>(picture.width) * picture.height);
  if (info(picture.format).bits > 8) {
    convert(picture, PixelFormat::Y16, reinterpret_cast<std::byte*>(counts.data()));
    return counts;
  }
  std::vector<std::uint8_t> grey(counts.size());
  convert(picture, PixelFormat::Grey, reinterpret_cast<std::byte*>(grey.data()));
  std::ranges::copy(grey, counts.begin());
  return counts;
}

/// Counts that become black and white, by those that are `seen`.
std::pair<double, double> range_of(Counts seen) {
  if (seen.empty()) return {0, 1};
  const auto percentile = [&](double share) {
    const auto place = seen.begin() + std::lround(share * static_cast<double>(seen.size() - 1));
    std::ranges::nth_element(seen, place);
    return static_cast<double>(*place);
  };
  const double low = percentile(kBlack);
  return {low, std::max(percentile(kWhite), low + 1)};
}

std::vector<std::uint8_t> stretched(const Counts& counts, Counts seen) {
  const auto [low, high] = range_of(std::move(seen));
  std::vector<std::uint8_t> grey(counts.size());
  std::ranges::transform(counts, grey.begin(), [low = low, high = high](std::uint16_t count) {
    const double share = (count - low) / (high - low);
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
  });
  return grey;
}

/// Shares the samples.
Picture grey_picture(std::vector<std::uint8_t>& grey, int width, int height) {
  return picture_of(PixelFormat::Grey,
                    ImageView<std::uint8_t>{grey.data(), width, height, 1, width});
}

Result<pipeline::StillView> rendered(const Picture& picture, const optics::BallProjection& ball,
                                     const optics::ViewSpec& view, PixelFormat format) {
  return optics::ViewProjection::make(view, ball).map([&](optics::ViewProjection projection) {
    const pipeline::StillSource source{picture, ball};
    return pipeline::render_once({std::move(projection), format}, {&source, 1});
  });
}

Result<std::string> luminance_jpeg(const Picture& picture, const optics::BallProjection& ball,
                                   const AlignmentPicture& asked) {
  Counts counts = counts_of(picture);
  if (!asked.view) {
    auto grey = stretched(counts, counts);
    return whole_jpeg(grey_picture(grey, picture.width, picture.height), asked);
  }
  const ImageView<std::uint16_t> samples{counts.data(), picture.width, picture.height, 1,
                                         picture.width};
  return rendered(picture_of(PixelFormat::Y16, samples), ball, *asked.view, PixelFormat::Y16)
      .and_then([](const pipeline::StillView& still) {
        const Counts shown = counts_of(still.picture);
        Counts seen;
        for (std::size_t n = 0; n < shown.size(); ++n) {
          if (still.validity[n] == static_cast<std::uint8_t>(Validity::Seen)) {
            seen.push_back(shown[n]);
          }
        }
        auto grey = stretched(shown, std::move(seen));
        return encoded(grey_picture(grey, still.picture.width, still.picture.height));
      });
}

}  // namespace

Result<std::string> alignment_jpeg(const Picture& picture, const optics::BallProjection& ball,
                                   const AlignmentPicture& asked) {
  if (info(picture.format).colour == ColourModel::Luminance) {
    return luminance_jpeg(picture, ball, asked);
  }
  if (!asked.view) return whole_jpeg(picture, asked);
  if (!remap::can_remap(picture.format, PixelFormat::Rgb)) {
    return fail("pictures of format " + std::string(info(picture.format).name) +
                " are not turned into views");
  }
  return rendered(picture, ball, *asked.view, PixelFormat::Rgb)
      .and_then([](const pipeline::StillView& still) { return encoded(still.picture); });
}

}  // namespace orbwatch::app
