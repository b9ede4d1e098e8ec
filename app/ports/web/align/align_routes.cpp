// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/align/align_routes.h"

#include <memory>

#include "app/ports/web/api/record.h"
#include "app/ports/web/http/entity_tag.h"

namespace orbwatch::app::web {

Response AlignRoutes::state() const {
  AlignmentAnswer answer;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    answer.cameras.push_back({cameras_[i], i, source_ ? source_->report(i) : AlignmentReport()});
  }
  Response response = json_response(json_text(json_of(answer)));
  response.tag = entity_tag(*response.body);
  return response;
}

void AlignRoutes::ball(const CameraQuery& query, const ExchangePtr& exchange) const {
  request(query, {}, exchange);
}

void AlignRoutes::view(const CameraViewQuery& query, const ExchangePtr& exchange) const {
  AlignmentPicture picture;
  picture.view = {optics::ViewKind::Perspective,
                  {query.yaw, query.pitch, 0},
                  query.h_fov,
                  {},
                  query.width,
                  query.height};
  picture.is_proposed = query.is_proposed;
  picture.model = query.model;
  request(query, picture, exchange);
}

Answered<DirectionAnswer> AlignRoutes::direction(const CameraPixelQuery& query) const {
  const auto camera = index_of("camera", query.camera, cameras_);
  if (!camera) return tl::unexpected(camera.error());
  const auto seen = source_ ? source_->direction(*camera, query.pixel) : std::nullopt;
  if (!seen) return refuse(404, "the ball is elsewhere in the picture");
  const optics::YawPitchRoll angles = optics::yaw_pitch(*seen);
  return DirectionAnswer{angles.yaw, angles.pitch};
}

void AlignRoutes::request(const CameraQuery& query, AlignmentPicture picture,
                          const ExchangePtr& exchange) const {
  const auto camera = index_of("camera", query.camera, cameras_);
  if (!camera) {
    exchange->answer(camera.error());
    return;
  }
  picture.camera = *camera;
  const auto on_picture = [exchange](Result<std::string> jpeg, hal::TimePoint /*stamp*/) {
    exchange->answer(jpeg ? body_response(kJpeg, std::move(*jpeg))
                          : error_response(409, jpeg.error().message));
  };
  const auto is_wanted = [exchange] { return !exchange->is_answered(); };
  const auto requested = source_ ? source_->request(picture, on_picture, is_wanted)
                                 : Result<>(fail("there is no camera to align"));
  if (!requested) exchange->answer(error_response(409, requested.error().message));
}

}  // namespace orbwatch::app::web
