// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/pixels/pixel.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/model/utc_text.h"
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

Pixel pixel_of(const View& view, const optics::ViewProjection& projection, const optics::Ball& ball,
               const optics::SceneProxy& scene, const optics::Vec2& at) {
  const int x = static_cast<int>(std::lround(at.u)), y = static_cast<int>(std::lround(at.v));
  Pixel pixel;
  pixel.validity = static_cast<Validity>(*view.validity.at(x, y));
  pixel.intensity = kPercentPerByte * (view.luminance.empty() ? luma_of(view.picture, x, y)
                                                              : *view.luminance.at(x, y));
  if (!view.counts.empty() && *view.counts.at(x, y) > 0) {
    pixel.temperature =
        kelvin_of_counts(*view.counts.at(x, y), view.kelvin_per_count, view.kelvin_offset) -
        kZeroCelsius;
  }
  pixel.direction = projection.direction(at.u, at.v);
  const double closeness = pixel.direction ? scene.hit(*pixel.direction).closeness : 0;
  if (closeness > 0) {
    pixel.distance = ball.radius / closeness;
    pixel.point = ball.centre + *pixel.direction * pixel.distance;
  }
  return pixel;
}

std::string pixel_json(const Pixel& pixel, std::uint64_t number, hal::TimePoint stamp) {
  using Json = nlohmann::ordered_json;
  Json json{{"number", number}, {"stamp", utc_text(hal::to_utc(stamp)).value_or("")}};
  const optics::YawPitchRoll angles =
      optics::yaw_pitch(pixel.direction.value_or(optics::Vec3{0, 1, 0}));
  json["yaw"] = pixel.direction ? Json(angles.yaw) : Json();
  json["pitch"] = pixel.direction ? Json(angles.pitch) : Json();
  json["seen"] = pixel.validity == Validity::Seen;
  json["intensity"] = pixel.intensity;
  json["temperature"] = pixel.temperature;
  json["distance"] = pixel.distance;
  const bool has_point = !std::isnan(pixel.distance);
  json["point"] = has_point ? Json{pixel.point.x, pixel.point.y, pixel.point.z} : Json();
  return json.dump();
}

}  // namespace orbwatch::app::web
