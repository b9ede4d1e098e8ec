#include "app/daemon/check.h"

#include <vector>

#include "app/daemon/by_name.h"
#include "app/daemon/recipes.h"
#include "app/daemon/view_plans.h"

namespace orbwatch::app {
namespace {

/// What the cameras will deliver as far as files tell it; limits in percent fit any depth.
std::vector<hal::StreamFormat> expected_formats(const Configuration& configuration) {
  std::vector<hal::StreamFormat> formats;
  for (const CameraSettings& camera : configuration.cameras) {
    const optics::RigCamera& known = by_name(configuration.rig.cameras, camera.name);
    hal::StreamFormat format;
    format.format = camera.kelvin_per_count > 0 ? PixelFormat::Y16 : PixelFormat::Grey;
    format.width = known.width;
    format.height = known.height;
    format.frame_rate = camera.frame_rate;
    formats.push_back(format);
  }
  return formats;
}

}  // namespace

Result<> check_plans(const Configuration& configuration) {
  const auto formats = expected_formats(configuration);
  for (std::size_t i = 0; i < configuration.views.size(); ++i) {
    const auto view = plan_view(configuration, configuration.views[i], i, formats);
    if (!view) return tl::unexpected(view.error());
  }
  const auto recipes = compile_recipes(configuration, formats);
  if (!recipes) return tl::unexpected(recipes.error());
  const DdsSettings& dds = configuration.dds;
  return dds.enabled && dds.security ? check_security(*dds.security, dds.domain) : Result<>();
}

}  // namespace orbwatch::app
