// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "app/cli/advise/advise_text.h"
#include "app/cli/command.h"
#include "app/cli/options/options.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kAdviseUsage =
    "Usage: orbwatch advise --ball-diameter MM --distance MM --focal MM --pixel UM --sensor WxH\n"
    "                       --target-distance MM [options]\n"
    "\n"
    "Says what a camera that looks at a mirror ball would show of a target: pixels per degree and\n"
    "millimetre, parallax, depth of field, the smallest thing that can be measured, and what to\n"
    "change.\n"
    "\n";

constexpr const char* kAdviseNotes =
    "\n"
    "The lens is taken for thin and free of distortion. The depth of field reaches from the "
    "mirror\n"
    "image of the target, up to half a radius behind the ball's front, to the ball's limb; the\n"
    "f-number keeps both sharp to a pixel.\n"
    "\n"
    "--json prints one object: alpha (degrees), ball_pixels (radius), fill (of the picture's "
    "short\n"
    "side), focus and depth_of_field (mm), f_number, diffraction_f_number, sights [{phi (degrees\n"
    "between target and camera), pixels_per_degree, pixels_per_mm, smallest (mm), parallax\n"
    "(degrees)}], changes [text].\n";

struct AdviseOptions {
  align::Arrangement arrangement;
  bool json = false;
};

std::vector<Option> declare(AdviseOptions& o) {
  align::Arrangement& s = o.arrangement;
  return {
      {"ball-diameter", 0, "MM", "of the ball", number_option("ball-diameter", s.ball_diameter)},
      {"distance", 0, "MM", "from the lens to the ball's centre",
       number_option("distance", s.distance)},
      {"focal", 0, "MM", "focal length of the lens", number_option("focal", s.focal_length)},
      {"pixel", 0, "UM", "from one of the sensor's pixels to the next, micrometres",
       number_option("pixel", s.pixel)},
      {"sensor", 0, "WxH", "the sensor's pixels",
       [&s](const std::string& value) {
         return parse_size("sensor", value).map([&s](const Size& size) {
           s.sensor_width = size.width;
           s.sensor_height = size.height;
         });
       }},
      {"target-distance", 0, "MM", "from the ball's centre to what is to be seen",
       number_option("target-distance", s.target_distance)},
      {"smallest", 0, "MM", "what is to be measured (default: whatever can be)",
       number_option("smallest", s.smallest)},
      {"json", 0, "", "for programs", flag_option(o.json)},
  };
}

CliResult<std::string> advise(const AdviseOptions& o) {
  const auto advice = align::advise(o.arrangement);
  if (!advice) return usage_error(advice.error().message);
  return o.json ? advise_json(*advice) : advise_text(o.arrangement, *advice);
}

}  // namespace

CliResult<std::string> advise_command(const Arguments& arguments) {
  AdviseOptions o;
  return run_command(arguments,
                     {.usage = kAdviseUsage, .options = declare(o), .notes = kAdviseNotes},
                     [&](const auto&) { return advise(o); });
}

}  // namespace orbwatch::app::cli
