// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/model/sink/view.h"
#include "hal/camera.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::pipeline {

/// Rule for merging the sources of a view that see the same pixel.
enum class Combine {
  Mix,       ///< blended by weight wherever they see well
  Sharpest,  ///< blended by weight and resolution: the sharper camera dominates
  Switch,    ///< the first source that sees it and delivers
};

/// One camera as a view uses it.
struct ViewSource {
  std::size_t camera = 0;  ///< index into FrameSet::frames
  hal::StreamFormat format;
  optics::BallProjection ball;
  double weight = 1;            ///< above 0; in a mixed view, beside its resolution
  remap::ColourMap colour_map;  ///< for one-channel formats: see make_colour_map()
  /// Strength of sharpening for display, 0..remap::kMaxSharpness, for formats that are sharpened
  /// and interpolated pixels; 0: none.
  double sharpness = 0;
  SourceColours colours{};  ///< settings that colour_map is made of
};

inline bool is_colour(const ViewSource& source) {
  return info(source.format.format).colour != ColourModel::Luminance;
}

inline bool counts_temperature(const ViewSource& source) {
  return source.format.kelvin_per_count > 0 && info(source.format.format).bytes_per_sample() == 2;
}

/// A view, ready to be compiled into a ViewRenderer.
struct ViewPlan {
  std::size_t index = 0;
  std::string name;
  optics::ViewProjection projection;
  std::vector<ViewSource> sources;  ///< 1..remap::kMaxSources
  Combine combine = Combine::Mix;
  remap::Interpolation interpolation = remap::Interpolation::Area;
  /// Which of `sources` is measured, raw; nullopt for a display view.
  std::optional<std::size_t> measured;
  std::uint64_t pointing = 0;  ///< see View::pointing
  bool match = true;           ///< brings its colour cameras together: see ExposureMatch

  /// The source whose raw plane may lie beside the picture: the measured one; of a display view the
  /// first that counts temperature. nullopt: none.
  std::optional<std::size_t> raw() const;
};

inline std::optional<std::size_t> ViewPlan::raw() const {
  if (measured) return measured;
  const auto found = std::ranges::find_if(sources, counts_temperature);
  if (found == sources.end()) return std::nullopt;
  return static_cast<std::size_t>(found - sources.begin());
}

}  // namespace orbwatch::app::pipeline
