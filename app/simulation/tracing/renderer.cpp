// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/tracing/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "app/simulation/scene/appearance.h"
#include "app/simulation/tracing/parallel_for.h"
#include "proc/image/celsius.h"

namespace orbwatch::app::simulation {
namespace {

std::span<const optics::Vec2> points_of(CameraKind kind) {
  static constexpr std::array<optics::Vec2, 4> kQuarters{
      {{-0.25, -0.25}, {0.25, -0.25}, {-0.25, 0.25}, {0.25, 0.25}}};
  static constexpr std::array<optics::Vec2, 1> kCentre{};
  if (kind == CameraKind::Thermal) return kCentre;
  return kQuarters;
}

}  // namespace

/// Picture that is being rendered.
struct Renderer::Moment {
  MovingThings things;
  std::byte* picture;

  std::uint8_t* bytes() const { return reinterpret_cast<std::uint8_t*>(picture); }
  std::uint16_t* words() const { return reinterpret_cast<std::uint16_t*>(picture); }
};

Renderer::Renderer(std::shared_ptr<const Machine> machine, const Pinhole& camera,
                   const Sensor& sensor)
    : machine_(std::move(machine)),
      camera_(camera),
      sensor_(sensor),
      tiles_(camera, machine_->settings().ball, points_of(sensor.kind)),
      at_rest_(static_cast<std::size_t>(row_bytes(format(), camera.width)) *
               static_cast<std::size_t>(camera.height)) {
  parallel_for(camera_.height, [this](int row) { trace_rest(row); });
}

PixelFormat Renderer::format() const {
  return sensor_.kind == CameraKind::Colour ? PixelFormat::Rgb : PixelFormat::Y16;
}

std::span<const optics::Vec2> Renderer::points() const { return points_of(sensor_.kind); }

Sight Renderer::sight(double u, double v) const {
  return sight_along(camera_.ray_through(u, v), machine_->settings().ball);
}

std::size_t Renderer::index(int u, int v) const {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width) +
         static_cast<std::size_t>(u);
}

std::uint16_t Renderer::counts(double celsius) const {
  const double exact =
      counts_of_kelvin(celsius + kZeroCelsius, sensor_.kelvin_per_count, sensor_.kelvin_offset);
  return static_cast<std::uint16_t>(std::clamp(std::round(exact), 0.0, 65535.0));
}

void Renderer::trace_rest(int row) {
  const MachineSettings& settings = machine_->settings();
  for (int u = 0; u < camera_.width; ++u) {
    Appearance mean;
    for (const optics::Vec2& point : points()) {
      const StaticEnd end = static_end(settings, sight(u + point.u, row + point.v));
      const Appearance look = appearance_of(settings, end.ray, end.hit);
      const double share = 1.0 / static_cast<double>(points().size());
      mean.light = mean.light + look.light * share;
      mean.temperature += look.temperature * share;
    }
    if (sensor_.kind == CameraKind::Colour) {
      const Rgb8 rgb = tone_.encode(mean.light);
      std::memcpy(at_rest_.data() + index(u, row) * sizeof(rgb), rgb.data(), sizeof(rgb));
    } else {
      const std::uint16_t count = counts(mean.temperature);
      std::memcpy(at_rest_.data() + index(u, row) * sizeof(count), &count, sizeof(count));
    }
  }
}

void Renderer::render(double seconds, std::byte* picture, Redraw redraw) const {
  std::memcpy(picture, at_rest_.data(), at_rest_.size());
  const Moment moment{MovingThings(machine_->settings(), seconds), picture};
  if (redraw == Redraw::Everything) {
    const Candidates all = moment.things.everything();
    redraw_area(moment, {0, 0, camera_.width, camera_.height}, {all, all});
    return;
  }
  tiles_.for_each_touched(moment.things, [&](const Area& area, const SightCandidates& candidates) {
    redraw_area(moment, area, candidates);
  });
}

void Renderer::redraw_area(const Moment& moment, const Area& area,
                           const SightCandidates& candidates) const {
  for (int v = area.top; v < area.bottom; ++v) {
    for (int u = area.left; u < area.right; ++u) {
      if (sensor_.kind == CameraKind::Colour) {
        redraw_colour(moment, u, v, candidates);
      } else {
        redraw_thermal(moment, u, v, candidates);
      }
    }
  }
}

void Renderer::redraw_colour(const Moment& moment, int u, int v,
                             const SightCandidates& candidates) const {
  std::uint8_t* const pixel = moment.bytes() + index(u, v) * std::tuple_size_v<Rgb8>;
  const Light behind = tone_.decode(pixel);
  Light sum;
  bool touched = false;
  for (const optics::Vec2& point : points()) {
    const Encounter met = moment.things.first_on(sight(u + point.u, v + point.v), candidates);
    touched = touched || met.kind != Encounter::Kind::None;
    sum = sum + light_of(moment, met, behind);
  }
  if (!touched) return;
  const Rgb8 rgb = tone_.encode(sum * (1.0 / static_cast<double>(points().size())));
  std::copy(rgb.begin(), rgb.end(), pixel);
}

void Renderer::redraw_thermal(const Moment& moment, int u, int v,
                              const SightCandidates& candidates) const {
  const Encounter met = moment.things.first_on(sight(u, v), candidates);
  if (met.kind != Encounter::Kind::None) moment.words()[index(u, v)] = counts(met.temperature);
}

Light Renderer::light_of(const Moment& moment, const Encounter& encounter,
                         const Light& behind) const {
  switch (encounter.kind) {
    case Encounter::Kind::None:
      return behind;
    case Encounter::Kind::Pool:
      return behind + tone_.incandescence(encounter.temperature);
    case Encounter::Kind::Spark:
      return tone_.incandescence(encounter.temperature);
    case Encounter::Kind::Nozzle: {
      const Nozzle& nozzle = moment.things.nozzle();
      return nozzle_light(machine_->settings(), encounter.point, nozzle.normal_at(encounter.point),
                          nozzle.is_cone(encounter.point));
    }
  }
  return behind;
}

}  // namespace orbwatch::app::simulation
