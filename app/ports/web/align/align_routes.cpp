// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/align/align_routes.h"

#include <chrono>
#include <memory>

#include "app/model/status/utc_text.h"
#include "app/ports/web/api/json_form.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/http/entity_tag.h"
#include "app/ports/web/streams/live_stream.h"

namespace orbwatch::app::web {
namespace {

AlignmentPicture asked_by(const CameraViewQuery& query) {
  AlignmentPicture picture;
  picture.view = {optics::ViewKind::Perspective,
                  {query.yaw, query.pitch, 0},
                  query.h_fov,
                  {},
                  query.width,
                  query.height};
  picture.is_proposed = query.is_proposed;
  picture.model = query.model;
  return picture;
}

/// A line of JSON with the name of its camera, then the file, one after the other.
std::string messages_of(const std::vector<std::string>& cameras, const AlignmentJpegs& jpegs) {
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const double age = Milliseconds(hal::Clock::now() - jpegs.stamp).count();
  const std::string stamp = utc_text(hal::to_utc(jpegs.stamp)).value_or("");
  std::string messages;
  for (std::size_t n = 0; n < cameras.size(); ++n) {
    const Json head{{"camera", cameras[n]},
                    {"stamp", stamp},
                    {"age_ms", age},
                    {"bytes", jpegs.files[n].size()}};
    messages += json_text(head) + "\n" + jpegs.files[n];
  }
  return messages;
}

}  // namespace

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
  request(query, asked_by(query), exchange);
}

void AlignRoutes::pair(const CameraViewQuery& query, const ExchangePtr& exchange) const {
  AlignmentPicture picture = asked_by(query);
  picture.is_beside_first = true;
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
  // The first camera's picture is the first one of a pair.
  const auto on_pictures = [exchange, names = std::vector{cameras_.front(), query.camera},
                            is_pair = picture.is_beside_first](const Result<AlignmentJpegs>& made) {
    exchange->answer(!made     ? error_response(409, made.error().message)
                     : is_pair ? body_response(LiveStream::kType, messages_of(names, *made))
                               : body_response(kJpeg, made->files.front()));
  };
  const auto is_wanted = [exchange] { return !exchange->is_answered(); };
  const auto requested = source_ ? source_->request(picture, on_pictures, is_wanted)
                                 : Result<>(fail("there is no camera to align"));
  if (!requested) exchange->answer(error_response(409, requested.error().message));
}

}  // namespace orbwatch::app::web
