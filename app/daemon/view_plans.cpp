#include "app/daemon/view_plans.h"

#include <array>
#include <optional>
#include <utility>

#include "app/daemon/by_name.h"
#include "app/pictures/colour_maps.h"

namespace orbwatch::app {
namespace {

remap::ColourMap colour_map(const SourceSettings& source, const CameraSettings& camera,
                            const hal::StreamFormat& format) {
  const auto range = source.range.value_or(std::array<double, 2>{0, 100});
  return {colour_map_table(source.colour_map), counts(range[0], camera, format),
          counts(range[1], camera, format)};
}

}  // namespace

double counts(double value, const CameraSettings& camera, const hal::StreamFormat& format) {
  if (camera.kelvin_per_count > 0) return (value + 273.15) / camera.kelvin_per_count;
  const double full_scale = (1 << info(format.format).bits) - 1;
  return value / 100 * full_scale;
}

Result<ViewPlan> plan_view(const Configuration& configuration, const ViewSettings& view,
                           std::size_t index, const std::vector<hal::StreamFormat>& formats,
                           const std::string& measured) {
  std::vector<ViewSource> sources;
  std::optional<std::size_t> measured_source;
  for (const SourceSettings& source : view.sources) {
    const std::size_t number = index_of(configuration.cameras, source.camera);
    const CameraSettings& camera = configuration.cameras[number];
    const optics::Rig& rig = configuration.rig;
    auto ball = optics::ball_projection(rig, by_name(rig.cameras, camera.name));
    if (!ball) return tl::unexpected(ball.error());
    if (source.camera == measured) measured_source = sources.size();
    sources.push_back({number, formats[number], *ball, source.weight,
                       colour_map(source, camera, formats[number])});
  }
  auto projection = optics::ViewProjection::make(view.spec(), sources.front().ball);
  if (!projection) return fail("view " + view.name + ": " + projection.error().message);
  return ViewPlan{index,        view.name,          *projection,    std::move(sources),
                  view.combine, view.interpolation, measured_source};
}

}  // namespace orbwatch::app
