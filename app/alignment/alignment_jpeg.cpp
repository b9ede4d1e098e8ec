#include "app/alignment/alignment_jpeg.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "app/pictures/colour_maps.h"
#include "app/pictures/jpeg_encoder.h"
#include "app/pictures/picture_conversion.h"
#include "app/pipeline/views/view_renderer.h"

namespace orbwatch::app {
namespace {

constexpr int kQuality = 90;
/// Share of the pixels that may be black or white; a lamp or a melt pool takes no more.
constexpr double kClipped = 0.005;

/// A picture of one plane with samples of its own.
struct OwnPicture {
  std::vector<std::byte> bytes;
  Picture picture;

  OwnPicture(PixelFormat format, int width, int height)
      : bytes(packed_bytes(format, width, height)) {
    picture = target(format, width, height);
  }
  OwnPicture(OwnPicture&&) = default;
  OwnPicture(const OwnPicture&) = delete;  // `picture` points into its own memory
  MutablePicture target(PixelFormat format, int width, int height) {
    return MutablePicture::contiguous(format, width, height, bytes.data(),
                                      row_bytes(format, width));
  }
};

/// The upper and lower ends of what is there.
std::pair<double, double> range_of(const ImageView<const std::uint16_t>& samples) {
  std::vector<std::uint16_t> sorted(samples.data,
                                    samples.data + std::ptrdiff_t(samples.width) * samples.height);
  const auto clipped = static_cast<std::ptrdiff_t>(kClipped * static_cast<double>(sorted.size()));
  std::ranges::nth_element(sorted, sorted.begin() + clipped);
  const double low = sorted[static_cast<std::size_t>(clipped)];
  std::ranges::nth_element(sorted, sorted.end() - 1 - clipped);
  const double high = *(sorted.end() - 1 - clipped);
  return {low, std::max(high, low + 1)};
}

OwnPicture stretched(const Picture& picture) {
  OwnPicture counts(PixelFormat::Y16, picture.width, picture.height);
  convert(picture, PixelFormat::Y16, counts.bytes.data());
  const auto samples = counts.picture.samples<std::uint16_t>();
  const auto [low, high] = range_of(samples);
  OwnPicture grey(PixelFormat::Grey, picture.width, picture.height);
  for (std::size_t n = 0; n < grey.bytes.size(); ++n) {
    const double share = (samples.data[n] - low) / (high - low);
    grey.bytes[n] = static_cast<std::byte>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
  }
  return grey;
}

Result<std::string> encoded(const Picture& picture) {
  JpegEncoder encoder;
  return encoder.encode(picture, kQuality).map([](std::span<std::uint8_t> jpeg) {
    return std::string(jpeg.begin(), jpeg.end());
  });
}

OwnPicture rendered(const Picture& picture, const optics::BallProjection& ball,
                    optics::ViewProjection view) {
  const bool is_grey = picture.format == PixelFormat::Grey;
  const PixelFormat format = is_grey ? PixelFormat::Grey : PixelFormat::Rgb;
  const auto frame = std::make_shared<hal::FrameBuffer>();
  frame->picture = picture;
  const hal::StreamFormat source{picture.format, picture.colour_space, picture.width,
                                 picture.height, 0};
  const remap::ColourMap unused(colour_map_table("grey"), 0, 255);
  OwnPicture shown(format, view.width(), view.height());
  std::vector<std::uint8_t> validity(static_cast<std::size_t>(view.width()) * view.height());
  const std::vector<hal::StreamFormat> formats{source};
  ViewPlan plan{0,  "alignment", std::move(view), {{0, source, ball, 1, unused, 0}}, Combine::Mix,
                {}, std::nullopt};
  hal::FrameSet set;
  set.frames[0] = frame;
  WorkerPool workers(0);
  const ViewRenderer renderer(std::move(plan));
  PictureUses uses;
  renderer.add_use(uses);
  FramePyramids pyramids(formats, uses);
  pyramids.build(set, uses, workers);
  const int width = shown.picture.width, height = shown.picture.height;
  renderer.render(pyramids,
                  {shown.target(format, width, height),
                   {validity.data(), width, height, 1, width},
                   {},
                   is_grey},
                  workers);
  return shown;
}

Result<std::string> shown(const Picture& picture, const optics::BallProjection& ball,
                          const std::optional<optics::ViewSpec>& view) {
  if (!view) return encoded(picture);
  if (picture.format != PixelFormat::Grey && !remap::can_remap(picture.format, PixelFormat::Rgb)) {
    return fail("pictures of format " + std::string(info(picture.format).name) +
                " are not turned into views");
  }
  return optics::ViewProjection::make(*view, ball).and_then([&](optics::ViewProjection projection) {
    return encoded(rendered(picture, ball, std::move(projection)).picture);
  });
}

}  // namespace

Result<std::string> alignment_jpeg(const Picture& picture, const optics::BallProjection& ball,
                                   const std::optional<optics::ViewSpec>& view) {
  const PixelFormatInfo& facts = info(picture.format);
  if (facts.colour == ColourModel::Luminance && facts.bits > 8) {
    return shown(stretched(picture).picture, ball, view);
  }
  return shown(picture, ball, view);
}

}  // namespace orbwatch::app
