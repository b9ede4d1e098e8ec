// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/alignment/placement.h"
#include "app/cli/options/options.h"
#include "app/cli/options/view_options.h"
#include "app/cli/place/tag_options.h"

namespace orbwatch::app::cli {

/// One camera's options.
struct PlaceCameraOptions {
  std::string name;             ///< in the rig
  std::filesystem::path image;  ///< in which ball and tags are to be found; may be empty
  bool focal_unknown = false;
  std::vector<KnownPoint> points;       ///< pixels of the camera's picture
  std::vector<KnownPoint> view_points;  ///< pixels of the view
};

/// The options of `orbwatch place` as they were given.
struct PlaceOptions {
  std::filesystem::path rig, output;
  std::vector<PlaceCameraOptions> cameras;
  std::vector<align::PrintedTag> tags;
  align::BallCentre::Knowledge centre = align::BallCentre::Knowledge::Known;
  double centre_sigma = 0;  ///< mm, when measured
  PlacePrecision precision;
  optics::ViewSpec view = kDefaultView;  ///< in which view points are marked
  bool json = false;
};

/// The options; they write into `options`, which outlives them.
std::vector<Option> place_options(PlaceOptions& options);

}  // namespace orbwatch::app::cli
