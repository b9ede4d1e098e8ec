// SPDX-License-Identifier: Apache-2.0
#include "app/cli/place/place_options.h"

#include <array>

#include "proc/settings/settings.h"

namespace orbwatch::app::cli {
namespace {

/// `text` as U,V=X,Y,Z.
Result<KnownPoint> parse_point(const std::string& name, const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto pixel = parse_numbers(name, text.substr(0, equals));
  const auto point =
      parse_numbers(name, equals == std::string::npos ? "" : text.substr(equals + 1));
  if (pixel && point && pixel->size() == 2 && point->size() == 3) {
    return KnownPoint{{(*pixel)[0], (*pixel)[1]}, {(*point)[0], (*point)[1], (*point)[2]}};
  }
  return fail("--" + name + " is \"" + text +
              "\"; it must be U,V=X,Y,Z: a pixel and the point that it shows, in mm");
}

/// set() for an option that belongs to the --camera before it.
std::function<Result<>(const std::string&)> of_camera(
    PlaceOptions& o, std::string name,
    std::function<Result<>(PlaceCameraOptions&, const std::string&)> set) {
  return [&o, name = std::move(name), set = std::move(set)](const std::string& value) -> Result<> {
    if (o.cameras.empty()) return fail("--" + name + " needs a --camera before it; see --help");
    return set(o.cameras.back(), value);
  };
}

Result<> set_centre(PlaceOptions& o, const std::string& value) {
  using Knowledge = align::BallCentre::Knowledge;
  constexpr std::array kWords{Word{"known", Knowledge::Known}, Word{"unknown", Knowledge::Unknown}};
  o.centre_sigma = 0;
  if (const Knowledge* word = find_word(kWords, value)) {
    o.centre = *word;
    return {};
  }
  const auto sigma = parse_number("ball-centre", value);
  if (!sigma || !(*sigma > 0)) {
    return fail("--ball-centre is \"" + value +
                "\"; use known, unknown, or how exactly it was measured, in mm");
  }
  o.centre = Knowledge::Measured;
  o.centre_sigma = *sigma;
  return {};
}

Result<> add_tags(PlaceOptions& o, const Result<std::vector<align::PrintedTag>>& tags) {
  if (!tags) return tl::unexpected(tags.error());
  o.tags.insert(o.tags.end(), tags->begin(), tags->end());
  return check_tags(o.tags);
}

Result<> add_camera(PlaceOptions& o, const std::string& name) {
  for (const PlaceCameraOptions& camera : o.cameras) {
    if (camera.name == name) return fail("--camera " + name + " is given twice");
  }
  o.cameras.push_back({name, {}, false, {}, {}});
  return {};
}

Result<> set_focal(PlaceCameraOptions& camera, const std::string& value) {
  constexpr std::array kWords{Word{"known", false}, Word{"unknown", true}};
  return word_option("focal", kWords, camera.focal_unknown)(value);
}

Result<> add_point(PlaceCameraOptions& camera, const std::string& value) {
  return parse_point("point", value).map([&](const KnownPoint& point) {
    camera.points.push_back(point);
  });
}

Result<> add_view_point(PlaceCameraOptions& camera, const std::string& value) {
  return parse_point("view-point", value).map([&](const KnownPoint& point) {
    camera.view_points.push_back(point);
  });
}

}  // namespace

std::vector<Option> place_options(PlaceOptions& o) {
  const auto set_image = [](PlaceCameraOptions& camera, const std::string& value) -> Result<> {
    camera.image = value;
    return {};
  };
  std::vector<Option> options{
      {"rig", 0, "RIG", "the rig file: the ball, and the cameras with their lenses",
       text_option(o.rig)},
      {"camera", 0, "NAME", "a camera to be placed; what follows is its own",
       [&o](const std::string& value) { return add_camera(o, value); }},
      {"point", 0, "U,V=X,Y,Z",
       "a pixel of the camera's picture, and the point that\nits ball shows there",
       of_camera(o, "point", add_point)},
      {"view-point", 0, "U,V=X,Y,Z",
       "a pixel of the view that `orbwatch project` makes\nof this camera with --rig, and the "
       "point that it\nshows; the view's options are the same as there",
       of_camera(o, "view-point", add_view_point)},
      {"image", 0, "PICTURE",
       "of this camera: tags are found in it, and the ball, if\nthe rig has no outline",
       of_camera(o, "image", set_image)},
      {"tag", 0, "ID=NUMBERS", "a printed AprilTag, 36h11, and where it hangs",
       [&o](const std::string& value) {
         return add_tags(o, parse_tag(value).map([](const align::PrintedTag& tag) {
           return std::vector<align::PrintedTag>{tag};
         }));
       }},
      {"tags", 0, "FILE", "the same for many: a line for each, # for comments",
       [&o](const std::string& value) { return add_tags(o, read_tags(value)); }},
      {"focal", 0, "KNOWN", "known (default), or unknown: the camera is not\ncalibrated",
       of_camera(o, "focal", set_focal)},
      {"ball-centre", 0, "HOW",
       "known: the rig's is right (default); unknown; or the\nrig's was measured this exactly, mm",
       [&o](const std::string& value) { return set_centre(o, value); }},
      {"sigma-px", 0, "PX", "how exactly points are marked (default 1)",
       number_option("sigma-px", o.precision.sigma_px)},
      {"sigma-mm", 0, "MM", "how exactly points are known (default 1)",
       number_option("sigma-mm", o.precision.sigma_mm)},
      {"outline-sigma", 0, "PX", "how exactly the ball's outline is known (default 1)",
       number_option("outline-sigma", o.precision.outline_sigma)},
      {"json", 0, "", "for programs", flag_option(o.json)},
      {"output", 'o', "RIG", "rig file to write, with what was found; may be the same\none",
       text_option(o.output)},
  };
  const auto view = view_options(o.view);
  options.insert(options.end(), view.begin(), view.end());
  return options;
}

}  // namespace orbwatch::app::cli
