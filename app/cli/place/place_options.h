#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/options/options.h"
#include "app/cli/options/view_options.h"
#include "app/cli/place/tag_options.h"
#include "proc/align/place/placement.h"

namespace orbwatch::app {

/// A known point and the pixel that shows it.
struct PointOption {
  optics::Vec2 pixel;
  optics::Vec3 point;  ///< mm
};

/// What was given of one camera.
struct PlaceCameraOptions {
  std::string name;             ///< in the rig
  std::filesystem::path image;  ///< in which ball and tags are to be found; may be empty
  bool focal_unknown = false;
  std::vector<PointOption> points;       ///< pixels of the camera's picture
  std::vector<PointOption> view_points;  ///< pixels of the view
};

/// The options of `orbwatch place` as they were given.
struct PlaceOptions {
  std::filesystem::path rig, output;
  std::vector<PlaceCameraOptions> cameras;
  std::vector<align::PrintedTag> tags;
  align::BallCentre::Knowledge centre = align::BallCentre::Knowledge::Known;
  double centre_sigma = 0;  ///< mm, when measured
  double sigma_px = 1;
  double sigma_mm = 1;
  double outline_sigma = 1;
  optics::ViewSpec view = kDefaultView;  ///< in which view points are marked
  bool json = false;
};

/// The options; they write into `options`, which outlives them.
std::vector<Option> place_options(PlaceOptions& options);

}  // namespace orbwatch::app
