// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "app/simulation/scene/moving_things.h"
#include "app/simulation/simulated_camera_settings.h"
#include "app/simulation/tracing/pinhole.h"
#include "app/simulation/tracing/tile_index.h"
#include "app/simulation/tracing/tone.h"
#include "proc/image/pixel_format.h"

namespace orbwatch::app::simulation {

/// Conversion of light or temperature to samples.
struct Sensor {
  CameraKind kind = CameraKind::Colour;
  double kelvin_per_count = 0.04;  ///< thermal: see kelvin_of_counts()
  double kelvin_offset = 0;        ///< temperature of a count of 0, K
};

/// Pixels that render() traces anew: those that may show a moving object, or all of them. The
/// result is the same, bit for bit; Everything is the slow reference for tests.
enum class Redraw : std::uint8_t { WhatMoves, Everything };

/// Renders pictures of the machine without noise. The static scene is traced once, in the
/// constructor, on all cores (about a second for a megapixel); then a picture costs a copy and the
/// pixels of moving objects. Immutable; reentrant.
class Renderer {
 public:
  Renderer(std::shared_ptr<const Machine> machine, const Pinhole& camera, const Sensor& sensor);

  PixelFormat format() const;

  /// Renders the machine `seconds` after its epoch, as samples of format(), rows without padding,
  /// aligned for them. `picture` must have size() bytes. No allocation.
  void render(double seconds, std::byte* picture, Redraw redraw = Redraw::WhatMoves) const;

  std::size_t size() const { return at_rest_.size(); }

 private:
  struct Moment;
  std::span<const optics::Vec2> points() const;
  void trace_rest(int row);
  void redraw_area(const Moment& moment, const Area& area, const SightCandidates& candidates) const;
  void redraw_colour(const Moment& moment, int u, int v, const SightCandidates& candidates) const;
  void redraw_thermal(const Moment& moment, int u, int v, const SightCandidates& candidates) const;
  Sight sight(double u, double v) const;
  Light light_of(const Moment& moment, const Encounter& encounter, const Light& behind) const;
  std::uint16_t counts(double celsius) const;
  std::size_t index(int u, int v) const;

  std::shared_ptr<const Machine> machine_;
  Pinhole camera_;
  Sensor sensor_;
  Tone tone_;
  TileIndex tiles_;
  std::vector<std::byte> at_rest_;  ///< picture of the static scene
};

}  // namespace orbwatch::app::simulation
