// SPDX-License-Identifier: Apache-2.0
#include "app/cli/options/view_options.h"

#include "app/pipeline/views/view_settings.h"

namespace orbwatch::app::cli {

std::vector<Option> view_options(optics::ViewSpec& view) {
  return {
      {"view", 0, "KIND",
       joined(pipeline::kViewKinds) +
           "\n(default perspective); ball is the first camera's own picture of it",
       word_option("view", pipeline::kViewKinds, view.kind)},
      {"yaw", 0, "DEG", "of the view, positive to the right",
       number_option("yaw", view.orientation.yaw)},
      {"pitch", 0, "DEG", "positive up", number_option("pitch", view.orientation.pitch)},
      {"roll", 0, "DEG", "positive: the right side dips",
       number_option("roll", view.orientation.roll)},
      {"h-fov", 0, "DEG",
       "edge to edge; perspective below 180 (default 90),\nequirectangular and cylindrical to 360 "
       "(default),\nstereographic below 360, fisheye to 360 (default 180)",
       number_option("h-fov", view.h_fov)},
      {"v-fov", 0, "DEG", "default: square pixels, or 180 for equirectangular",
       number_option("v-fov", view.v_fov)},
      {"size", 0, "WxH", "of the view, 1x1 to 16384x16384 (default 1280x720)",
       [&view](const std::string& value) {
         return parse_size("size", value).map([&view](const Size& size) {
           view.width = size.width;
           view.height = size.height;
         });
       }},
  };
}

}  // namespace orbwatch::app::cli
