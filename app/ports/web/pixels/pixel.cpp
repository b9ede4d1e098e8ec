// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/pixels/pixel.h"

#include <cmath>

#include "app/model/status/utc_text.h"
#include "proc/image/celsius.h"
#include "proc/optics/rotation.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::web {
namespace {

constexpr double kPercentPerByte = 100.0 / 255;

double luma_of(const MutablePicture& picture, int x, int y) {
  const std::uint8_t* const samples = picture.samples<std::uint8_t>().at(x, y);
  if (info(picture.format).colour != ColourModel::Rgb) return samples[0];
  if (picture.format == PixelFormat::Rgb) return remap::luma(samples);
  const std::uint8_t rgb[] = {samples[2], samples[1], samples[0]};
  return remap::luma(rgb);
}

}  // namespace

PixelAnswer pixel_of(const View& view, const optics::ViewProjection& projection,
                     const optics::Ball& ball, const optics::SceneProxy& scene,
                     const optics::Vec2& at) {
  const int x = static_cast<int>(std::lround(at.u)), y = static_cast<int>(std::lround(at.v));
  PixelAnswer pixel;
  pixel.stamp = utc_text(hal::to_utc(view.stamp)).value_or("");
  pixel.seen = static_cast<Validity>(*view.validity.at(x, y)) == Validity::Seen;
  pixel.intensity = kPercentPerByte * (view.luminance.empty() ? luma_of(view.picture, x, y)
                                                              : *view.luminance.at(x, y));
  if (!view.counts.empty() && *view.counts.at(x, y) > 0) {
    pixel.temperature =
        kelvin_of_counts(*view.counts.at(x, y), view.kelvin_per_count, view.kelvin_offset) -
        kZeroCelsius;
  }
  const auto direction = projection.direction(at.u, at.v);
  if (!direction) return pixel;
  const optics::YawPitchRoll angles = optics::yaw_pitch(*direction);
  pixel.yaw = angles.yaw;
  pixel.pitch = angles.pitch;
  const double closeness = scene.hit(*direction).closeness;
  if (closeness > 0) {
    pixel.distance = ball.radius / closeness;
    pixel.point = ball.centre + *direction * pixel.distance;
  }
  return pixel;
}

}  // namespace orbwatch::app::web
