// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/align/align_routes.h"

#include <algorithm>
#include <memory>

#include "app/ports/web/align/alignment_text.h"
#include "app/ports/web/query.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::web {
namespace {

constexpr int kDefaultSide = 480;
/// A view is computed for each request.
constexpr int kLargestSide = 1920;

const QueryArgument kCamera{"camera", "Name of the camera", true, false};
const QueryArgument kWhich{"which", "proposed or in_force; default: in_force", false, false};

Result<optics::ViewSpec> view_of(const Request& request) {
  optics::ViewSpec view;
  const auto yaw = number_of(request, "yaw", 0, -180, 180);
  const auto pitch = number_of(request, "pitch", 0, -90, 90);
  const auto h_fov = number_of(request, "h_fov", 90, 1, 170);
  const auto width = number_of(request, "width", kDefaultSide, 16, kLargestSide);
  const auto height = number_of(request, "height", kDefaultSide, 16, kLargestSide);
  for (const auto* number : {&yaw, &pitch, &h_fov, &width, &height}) {
    if (!*number) return tl::unexpected(number->error());
  }
  view.orientation = {*yaw, *pitch, 0};
  view.h_fov = *h_fov;
  view.width = static_cast<int>(*width);
  view.height = static_cast<int>(*height);
  return view;
}

}  // namespace

std::vector<Route> AlignRoutes::routes() {
  Route state;
  state.method = "GET";
  state.path = "/api/v1/alignment";
  state.role = Role::Viewer;
  state.description =
      "Returns per camera the ball's outline, the pose, the proposal, the points with residuals, "
      "and the scene's edges as seen from the ball's centre and in the picture; px, deg, mm";
  state.type = kJson;
  state.serve = [this](const ExchangePtr& exchange) { serve_alignment(exchange); };
  Route ball = state;
  ball.path = "/api/v1/alignment/ball.jpg";
  ball.description = "Returns a camera's next picture in full resolution";
  ball.type = kJpeg;
  ball.query = {kCamera};
  ball.serve = [this](const ExchangePtr& exchange) { serve_picture(exchange, false); };
  Route view = ball;
  view.path = "/api/v1/alignment/view.jpg";
  view.description =
      "Returns the next perspective view from one camera alone, to judge its alignment";
  view.query = {kCamera,
                kWhich,
                {"yaw", "yaw, deg, from +Y towards +X; default: 0"},
                {"pitch", "pitch, deg, up positive; default: 0"},
                {"h_fov", "horizontal field of view, deg; default: 90"},
                {"width", "px; default: 480"},
                {"height", "px; default: 480"},
                {"model", "exact, paper or classical; default: the rig's model", false, false}};
  view.serve = [this](const ExchangePtr& exchange) { serve_picture(exchange, true); };
  Route direction = state;
  direction.path = "/api/v1/alignment/direction";
  direction.description =
      "Returns the direction, seen from the ball's centre, of a pixel in a camera's picture, by "
      "the proposed alignment if there is one; deg";
  direction.query = {
      kCamera, {"u", "px, to the right, pixel centres at integers", true}, {"v", "px, down", true}};
  direction.serve = [this](const ExchangePtr& exchange) { serve_direction(exchange); };
  return {std::move(state), std::move(ball), std::move(view), std::move(direction)};
}

void AlignRoutes::serve_alignment(const ExchangePtr& exchange) const {
  std::vector<AlignmentReport> reports(cameras_.size());
  for (std::size_t i = 0; source_ && i < cameras_.size(); ++i) reports[i] = source_->report(i);
  exchange->answer(json_response(alignment_json(cameras_, reports)));
}

Result<std::size_t> AlignRoutes::camera_of(const Request& request) const {
  const std::string* name = request.argument(kCamera.name);
  const auto camera = name ? std::ranges::find(cameras_, *name) : cameras_.end();
  if (camera != cameras_.end()) return static_cast<std::size_t>(camera - cameras_.begin());
  return fail("unknown camera; pass ?camera=NAME with a name from /api/v1/alignment");
}

void AlignRoutes::serve_direction(const ExchangePtr& exchange) const {
  const auto camera = camera_of(exchange->request());
  const auto u = number_of(exchange->request(), "u", -kMaxSide, kMaxSide);
  const auto v = number_of(exchange->request(), "v", -kMaxSide, kMaxSide);
  if (!camera || !u || !v) {
    const Error& error = !camera ? camera.error() : !u ? u.error() : v.error();
    exchange->answer(error_response(400, error.message));
    return;
  }
  const auto seen = source_ ? source_->direction(*camera, {*u, *v}) : std::nullopt;
  if (!seen) {
    exchange->answer(error_response(404, "the ball is elsewhere in the picture"));
    return;
  }
  exchange->answer(json_response(direction_json(*seen)));
}

Result<AlignmentPicture> AlignRoutes::picture_of(const Request& request, bool is_view) const {
  AlignmentPicture picture;
  const auto camera = camera_of(request);
  if (!camera) return tl::unexpected(camera.error());
  picture.camera = *camera;
  if (!is_view) return picture;
  const std::string* which = request.argument(kWhich.name);
  picture.is_proposed = which && *which == "proposed";
  if (which && *which != "proposed" && *which != "in_force") {
    return fail("which is " + *which + "; it must be proposed or in_force");
  }
  if (const std::string* model = request.argument("model")) {
    const auto* const known = find_word(optics::kBallModels, *model);
    if (!known) {
      return fail("model is " + *model + "; it must be one of " + joined(optics::kBallModels));
    }
    picture.model = *known;
  }
  return view_of(request).map([&](const optics::ViewSpec& view) {
    picture.view = view;
    return picture;
  });
}

void AlignRoutes::serve_picture(const ExchangePtr& exchange, bool is_view) const {
  const auto picture = picture_of(exchange->request(), is_view);
  if (!picture) {
    exchange->answer(error_response(400, picture.error().message));
    return;
  }
  const auto on_picture = [exchange](Result<std::string> jpeg) {
    if (!jpeg) {
      exchange->answer(error_response(409, jpeg.error().message));
      return;
    }
    Response response;
    response.type = kJpeg;
    response.body = std::make_shared<const std::string>(std::move(*jpeg));
    exchange->answer(std::move(response));
  };
  const auto is_wanted = [exchange] { return !exchange->is_answered(); };
  const auto requested = source_ ? source_->request(*picture, on_picture, is_wanted)
                                 : Result<>(fail("there is no camera to align"));
  if (!requested) exchange->answer(error_response(409, requested.error().message));
}

}  // namespace orbwatch::app::web
