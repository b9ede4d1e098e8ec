// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/measured_region.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace orbwatch::bench {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr double kFrame = 0.033;  // s

/// A view of the floor around the process.
optics::ViewProjection view_of_floor() {
  optics::ViewSpec spec{optics::ViewKind::Perspective, {30, -60, 20}, 50, {}, kWidth, kHeight};
  return optics::ViewProjection::make(spec).value();
}

/// A ball of 50 mm above a floor 400 mm below its centre.
signals::RegionScene floor_scene() {
  optics::Scene scene;
  scene.room = optics::Scene::Room::Plane;
  scene.point = {0, 0, -300};
  scene.normal = {0, 0, 1};
  const optics::Ball ball{{10, 20, 100}, 50};
  return {ball, optics::SceneProxy::make(scene, ball).value()};
}

std::vector<optics::Vec3> outline_in(const optics::ViewProjection& view) {
  std::vector<optics::Vec3> outline;
  for (const auto& [x, y] :
       {std::pair{0.3, 0.05}, {0.75, 0.1}, {0.95, 0.6}, {0.5, 0.9}, {0.1, 0.7}}) {
    outline.push_back(*view.direction(x * kWidth, y * kHeight));
  }
  return outline;
}

double full_scale(const RegionCase& wanted) { return std::exp2(wanted.bits) - 1; }

signals::RegionMeter meter_for(const RegionCase& wanted, const optics::ViewProjection& view) {
  signals::RegionSettings settings;
  settings.outline = outline_in(view);
  settings.full_scale = full_scale(wanted);
  settings.hot_spot_threshold = 0.5 * settings.full_scale;
  settings.plume_threshold = 0.4 * settings.full_scale;
  settings.spatter_threshold = 0.3 * settings.full_scale;
  if (wanted.bits == 16) settings.radiometry.kelvin_per_count = 0.04;
  return signals::RegionMeter::make(view, floor_scene(), settings).value();
}

}  // namespace

MeasuredRegion::MeasuredRegion(const RegionCase& wanted)
    : wanted_(wanted),
      view_(view_of_floor()),
      meter_(meter_for(wanted, view_)),
      pixels_(signals::RegionMask::make(view_, outline_in(view_)).value().pixels()) {
  validity_.assign(std::size_t{kWidth} * kHeight, static_cast<std::uint8_t>(Validity::Seen));
  for (int y = 0; y < kHeight / 8; ++y) {
    for (int x = kWidth / 2; x < kWidth; ++x) {
      validity_[static_cast<std::size_t>(y) * kWidth + x] = 0;
    }
  }
  for (unsigned i = 0; i < words_.size(); ++i) {
    paint(words_[i], i + 1);
    if (wanted.bits == 8) bytes_[i].assign(words_[i].begin(), words_[i].end());
  }
}

void MeasuredRegion::paint(std::vector<std::uint16_t>& counts, unsigned seed) const {
  const double scale = full_scale(wanted_);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> cold(0, static_cast<int>(0.25 * scale));
  std::uniform_int_distribution<int> hot(static_cast<int>(0.55 * scale), static_cast<int>(scale));
  std::bernoulli_distribution is_noise(wanted_.noise);
  // Counts form a hill that crosses the hot spot's threshold at the radius.
  const double square = wanted_.hot_spot * static_cast<double>(pixels_) / std::numbers::pi;
  counts.reserve(std::size_t{kWidth} * kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double u = x - kWidth / 2.0 - seed, v = y - kHeight / 2.0;
      const double hill = square > 0 ? scale * std::exp2(-(u * u + v * v) / square) : 0;
      const int noise = is_noise(random) ? hot(random) : cold(random);
      counts.push_back(static_cast<std::uint16_t>(std::max<double>(noise, hill)));
    }
  }
}

void MeasuredRegion::run() {
  const ImageView<const std::uint8_t> seen{validity_.data(), kWidth, kHeight, 1, kWidth};
  const auto n = static_cast<std::size_t>(frame_set_ % 2);
  const double now = 1 + kFrame * frame_set_++;
  if (wanted_.bits == 8) {
    meter_.measure(ImageView<const std::uint8_t>{bytes_[n].data(), kWidth, kHeight, 1, kWidth},
                   seen, now);
  } else {
    meter_.measure(ImageView<const std::uint16_t>{words_[n].data(), kWidth, kHeight, 1, kWidth},
                   seen, now);
  }
}

}  // namespace orbwatch::bench
