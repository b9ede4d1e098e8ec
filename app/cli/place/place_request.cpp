#include "app/cli/place/place_request.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "app/alignment/found_outline.h"
#include "app/alignment/placement.h"
#include "app/cli/options/camera_options.h"
#include "hal/replay/picture_decoder.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {
namespace {

using align::PlaceRequest;

Result<hal::DecodedPicture> picture_of(const std::filesystem::path& file,
                                       const optics::RigCamera& camera) {
  auto decoded = hal::read_picture(file);
  if (!decoded) return tl::unexpected(decoded.error());
  const Picture& picture = decoded->picture;
  if (picture.width == camera.width && picture.height == camera.height) return decoded;
  return fail(file.string() + " has " + std::to_string(picture.width) + "x" +
              std::to_string(picture.height) + " pixels, camera " + camera.name + " of the rig " +
              std::to_string(camera.width) + "x" + std::to_string(camera.height) +
              exif_note(*decoded));
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

/// Marks points where the camera's picture has what the view shows: by the way that the view was
/// made, whether the rig is right or not.
Result<> mark_in_view(const PlaceOptions& o, const PlaceCameraOptions& options,
                      const optics::Rig& rig, const optics::RigCamera& known,
                      align::UnplacedCamera& camera, PlaceRequest& request) {
  const auto ball = optics::ball_projection(rig, known);
  if (!ball) return tl::unexpected(ball.error());
  const auto view = optics::ViewProjection::make(o.view, *ball);
  if (!view) return tl::unexpected(view.error());
  for (const PointOption& point : options.view_points) {
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
    camera.marks.push_back({align::add_point(request, point.point), *pixel});
  }
  return {};
}

Result<align::UnplacedCamera> unplaced(const PlaceOptions& o, const PlaceCameraOptions& options,
                                       const optics::Rig& rig, const optics::RigCamera& camera,
                                       PlaceRequest& request, Progress& progress) {
  auto begun = unplaced_camera(camera, options.focal_unknown);
  if (!begun) return tl::unexpected(begun.error());
  align::UnplacedCamera out = std::move(*begun);
  std::optional<hal::DecodedPicture> picture;
  if (!options.image.empty()) {
    auto read = picture_of(options.image, camera);
    if (!read) return tl::unexpected(read.error());
    picture = std::move(*read);
    progress.begin("looking for the ball in " + options.image.filename().string());
  }
  const auto outline = outline_of(options, camera, picture ? &picture->picture : nullptr);
  if (!outline) return tl::unexpected(outline.error());
  out.outline = *outline;
  out.outline_sigma = o.outline_sigma;
  for (const PointOption& point : options.points) {
    out.marks.push_back({align::add_point(request, point.point), point.pixel});
  }
  if (!options.view_points.empty()) {
    if (auto marked = mark_in_view(o, options, rig, camera, out, request); !marked) {
      return tl::unexpected(marked.error());
    }
  }
  if (picture && !o.tags.empty()) {
    progress.begin("looking for tags in " + options.image.filename().string());
    if (auto marked = align::mark_tags(picture->picture, o.tags, out, request); !marked) {
      return tl::unexpected(marked.error());
    }
  }
  return out;
}

}  // namespace

Result<PlaceRequest> place_request(const PlaceOptions& o, const optics::Rig& rig,
                                   Progress& progress) {
  const auto has_image = [](const PlaceCameraOptions& camera) { return !camera.image.empty(); };
  if (!o.tags.empty() && std::ranges::none_of(o.cameras, has_image)) {
    return usage_error("tags are found in pictures: give --image after its --camera");
  }
  PlaceRequest request;
  request.centre = {o.centre, rig.ball.centre, o.centre_sigma};
  request.ball_radius = rig.ball.radius;
  request.sigma_px = o.sigma_px;
  request.sigma_mm = o.sigma_mm;
  for (const PlaceCameraOptions& options : o.cameras) {
    const auto camera = find_camera(rig, options.name);
    if (!camera) return tl::unexpected(camera.error());
    auto out = unplaced(o, options, rig, *camera, request, progress);
    if (!out) return tl::unexpected(out.error());
    request.cameras.push_back(std::move(*out));
  }
  return request;
}

}  // namespace orbwatch::app
