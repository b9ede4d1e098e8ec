// SPDX-License-Identifier: Apache-2.0
#include "app/cli/place/place_request.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "app/alignment/found_outline.h"
#include "app/alignment/picture_size.h"
#include "app/alignment/placement.h"
#include "app/cli/options/camera_options.h"
#include "hal/replay/picture_decoder.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app::cli {
namespace {

using align::PlaceRequest;

Result<hal::DecodedPicture> picture_of(const std::filesystem::path& file,
                                       const optics::RigCamera& camera) {
  auto decoded = hal::read_picture(file);
  if (!decoded) return tl::unexpected(decoded.error());
  if (const auto fits = check_picture_size(*decoded, camera); !fits) {
    return fail(file.string() + ": " + fits.error().message);
  }
  return decoded;
}

/// The rig's, or else what is found in the picture.
Result<optics::Outline> outline_of(const PlaceCameraOptions& options,
                                   const optics::RigCamera& camera, const Picture* picture) {
  if (camera.outline) return *camera.outline;
  if (!picture) {
    return fail("camera " + camera.name +
                " has no outline in the rig; give --image, a picture in which the ball is found");
  }
  const auto ball = found_outline(*picture);
  if (!ball) return fail(options.image.string() + ": " + ball.error().message);
  return ball->outline;
}

/// Error: points in a view of a camera that the rig does not place.
Result<> check_view_points(const PlaceCameraOptions& options, const optics::RigCamera& camera) {
  if (options.view_points.empty() || !is_unplaced(camera)) return {};
  return fail("camera " + camera.name +
              " has no place in the rig, without which no view can be made of it; give --point, a "
              "pixel of its picture, instead of --view-point");
}

/// Adds the pixels at which the camera's picture has what the view shows: by the way that the view
/// was made, whether the rig is right or not.
Result<> add_view_points(const PlaceOptions& o, const PlaceCameraOptions& options,
                         const optics::Rig& rig, const optics::RigCamera& known,
                         std::vector<KnownPoint>& points) {
  if (options.view_points.empty()) return {};
  const auto ball = optics::ball_projection(rig, known);
  if (!ball) return tl::unexpected(ball.error());
  const auto view = optics::ViewProjection::make(o.view, *ball);
  if (!view) return tl::unexpected(view.error());
  for (const KnownPoint& point : options.view_points) {
    const auto [u, v] = point.pixel;
    const bool is_inside =
        u >= -0.5 && v >= -0.5 && u < view->width() - 0.5 && v < view->height() - 0.5;
    const auto direction = is_inside ? view->direction(u, v) : std::nullopt;
    const auto pixel = direction ? ball->pixel(*direction) : std::nullopt;
    if (!pixel) {
      std::ostringstream text;
      text << "camera " << options.name << ": the view of " << view->width() << "x"
           << view->height() << " pixels shows nothing of it at (" << u << ", " << v << ")";
      return fail(text.str());
    }
    points.push_back({*pixel, point.point});
  }
  return {};
}

Result<> add_camera(const PlaceOptions& o, const PlaceCameraOptions& options,
                    const optics::Rig& rig, PlaceRequest& request, Progress& progress) {
  const auto camera = find_camera(rig, options.name);
  if (!camera) return tl::unexpected(camera.error());
  if (auto checked = check_view_points(options, *camera); !checked) return checked;
  auto unplaced = unplaced_camera(*camera, options.focal_unknown);
  if (!unplaced) return tl::unexpected(unplaced.error());
  std::optional<hal::DecodedPicture> decoded;
  if (!options.image.empty()) {
    auto read = picture_of(options.image, *camera);
    if (!read) return tl::unexpected(read.error());
    decoded = std::move(*read);
    progress.begin("looking for the ball in " + options.image.filename().string());
  }
  const Picture* const picture = decoded ? &decoded->picture : nullptr;
  const auto outline = outline_of(options, *camera, picture);
  if (!outline) return tl::unexpected(outline.error());
  unplaced->outline = *outline;
  unplaced->outline_sigma = o.precision.outline_sigma;
  std::vector<KnownPoint> points = options.points;
  if (auto added = add_view_points(o, options, rig, *camera, points); !added) return added;
  if (picture && !o.tags.empty()) {
    progress.begin("looking for tags in " + options.image.filename().string());
  }
  return add_camera(request, std::move(*unplaced), points, picture, o.tags);
}

}  // namespace

CliResult<PlaceRequest> place_request(const PlaceOptions& o, const optics::Rig& rig,
                                      Progress& progress) {
  const auto has_image = [](const PlaceCameraOptions& camera) { return !camera.image.empty(); };
  if (!o.tags.empty() && std::ranges::none_of(o.cameras, has_image)) {
    return usage_error("tags are found in pictures: give --image after its --camera");
  }
  auto request = place_request(rig, o.precision, o.centre, o.centre_sigma);
  for (const PlaceCameraOptions& options : o.cameras) {
    if (auto added = add_camera(o, options, rig, request, progress); !added) {
      return tl::unexpected(added.error());
    }
  }
  return request;
}

}  // namespace orbwatch::app::cli
