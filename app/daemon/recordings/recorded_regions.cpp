// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/recordings/recorded_regions.h"

#include <array>
#include <cstddef>
#include <optional>

#include "app/daemon/recordings/recorded_site.h"
#include "app/daemon/site/published.h"
#include "hal/mcap/reader.h"
#include "proc/signals/spherical_polygon.h"

namespace orbwatch::app::daemon {
namespace {

using PixelLines = std::vector<std::vector<optics::Vec2>>;

/// Border of a view, whose straight edges are curves in a ball.
PixelLines border_in(const optics::ViewProjection& view, const optics::ViewProjection& ball) {
  constexpr int kPieces = 32;  // of an edge
  const double right = view.width() - 0.5, bottom = view.height() - 0.5;
  const std::array<optics::Vec2, 5> corners{
      {{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}, {-0.5, -0.5}}};
  PixelLines lines(1);
  const auto add = [&](double u, double v) {
    const auto direction = view.direction(u, v);
    const auto pixel = direction ? ball.pixel(*direction) : std::nullopt;
    if (pixel) lines.back().push_back(*pixel);
    if (!pixel && !lines.back().empty()) lines.emplace_back();
  };
  for (std::size_t edge = 0; edge + 1 < corners.size(); ++edge) {
    const auto &from = corners[edge], &to = corners[edge + 1];
    for (int k = 0; k <= kPieces; ++k) {
      const double share = static_cast<double>(k) / kPieces;
      add(from.u + share * (to.u - from.u), from.v + share * (to.v - from.v));
    }
  }
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

/// Outline of a region; a region without one is the whole view.
PixelLines lines_in(const MeasuredRecipe& recipe, const MeasuredRecipe::Region& region,
                    const optics::ViewProjection& ball) {
  if (region.outline.empty()) return border_in(*recipe.views[region.view].projection, ball);
  const auto polygon = signals::SphericalPolygon::make(region.outline);
  return polygon ? polygon->lines_in(ball) : PixelLines();
}

}  // namespace

Result<std::vector<RecordedRecipe>> recorded_regions(const std::filesystem::path& recording) {
  auto reader = hal::mcap::Reader::open(recording);
  if (!reader) return fail(reader.error().message);
  const auto site = recorded_site(recording, *reader);
  if (!site) return tl::unexpected(site.error());
  const auto plan = SitePlan::make(*site, expected_formats(*site));
  if (!plan) return tl::unexpected(plan.error());
  const auto balls = camera_balls(*site);
  const auto measured = measured_recipes(*site, *plan);
  std::vector<RecordedRecipe> recipes;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    RecordedRecipe& recipe = recipes.emplace_back();
    recipe.number = measured[i].number;
    for (const MeasuredRecipe::Region& region : measured[i].regions) {
      for (const auto& source : site->recipes[i].views[region.view].sources) {
        const std::size_t camera = source.camera.index;
        if (!balls[camera]) continue;
        recipe.regions.push_back({region.name, site->site.cameras[camera].name,
                                  lines_in(measured[i], region, *balls[camera])});
      }
    }
  }
  return recipes;
}

}  // namespace orbwatch::app::daemon
