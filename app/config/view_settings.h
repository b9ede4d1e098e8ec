#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/pipeline/view_renderer.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/remap.h"

namespace orbwatch::app {

/// What files say about a view; the keys stand in view_schema.h.

struct SourceSettings {
  int line = 0;
  std::string camera;
  double weight = 1;
  std::string colour_map = "grey";
  std::optional<std::array<double, 2>> range;
};

struct ViewSettings {
  int line = 0;
  std::string name;
  optics::ViewKind kind = optics::ViewKind::Perspective;
  double yaw = 0;
  double pitch = 0;
  double roll = 0;
  std::optional<double> h_fov;
  std::optional<double> v_fov;
  int width = 0;
  int height = 0;
  Combine combine = Combine::Mix;
  remap::Interpolation interpolation = remap::Interpolation::Area;
  PixelFormat encoding = PixelFormat::Rgb;
  std::vector<SourceSettings> sources;

  optics::ViewSpec spec() const { return {kind, {yaw, pitch, roll}, h_fov, v_fov, width, height}; }
};

/// A view that a recipe measures in; nobody points it elsewhere.
struct MeasuredViewSettings : ViewSettings {
  std::string measured;  ///< the camera among its sources
};

}  // namespace orbwatch::app
