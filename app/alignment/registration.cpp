// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/registration.h"

#include <cmath>
#include <string>
#include <utility>

#include "app/alignment/figure_text.h"
#include "app/alignment/reference_sigma.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

Result<align::SimultaneousPictures> simultaneous(std::span<const RecordedPicture> reference,
                                                 std::span<const RecordedPicture> camera,
                                                 std::chrono::nanoseconds window) {
  align::SimultaneousPictures pictures;
  std::size_t next = 0;
  for (const RecordedPicture& one : reference) {
    if (next == camera.size()) break;
    const auto apart = [&](std::size_t n) { return std::chrono::abs(camera[n].time - one.time); };
    std::size_t nearest = next;
    while (nearest + 1 < camera.size() && apart(nearest + 1) <= apart(nearest)) ++nearest;
    if (apart(nearest) > window) continue;
    pictures.reference.push_back(one.picture);
    pictures.camera.push_back(camera[nearest].picture);
    next = nearest + 1;
  }
  if (pictures.camera.empty()) return fail("the cameras took no pictures at the same moment");
  return pictures;
}

Result<CameraAlignment> registered_alignment(const optics::RigCamera& camera,
                                             const align::SoughtCamera& sought,
                                             const align::Registration& registration) {
  CameraAlignment alignment{.camera = camera.name};
  if (!camera.pose) {
    alignment.outline = registration.outline;
    alignment.registration = registration.rotation;
    return alignment;
  }
  return align::pose_of(sought, registration).map([&](const optics::Pose& pose) {
    alignment.pose = pose;
    return alignment;
  });
}

Result<FoundRegistration> register_camera(const optics::Rig& rig,
                                          const optics::RigCamera& reference,
                                          const optics::RigCamera& camera,
                                          const align::SimultaneousPictures& pictures,
                                          const RegistrationSettings& settings,
                                          const align::WorkProgress& progress) {
  const auto ball = optics::ball_projection(rig, reference);
  if (!ball) return tl::unexpected(ball.error());
  auto turnable = align::by_outline(rig, camera);
  if (!turnable) return tl::unexpected(turnable.error());
  if (settings.outline) turnable->outline = settings.outline;
  const align::SoughtCamera sought{pictures.camera.front(), rig, *std::move(turnable),
                                   settings.outline_sigma, settings.keeps_outline};
  const auto found = align::register_camera(pictures, *ball, sought, settings.method, progress);
  if (!found) return tl::unexpected(found.error());
  const align::Registration& best = found->registration;
  return registered_alignment(camera, sought, best).map([&](const CameraAlignment& alignment) {
    const double relative = align::direction_sigma(best);
    const double sigma = std::hypot(relative, kReferenceSigma);
    return FoundRegistration{
        *found,
        {alignment,
         "register by " + std::string(word_for(align::kRegistrationMethods, found->method)),
         figure_text("residual", best.residual, "deg rms") + ", " +
             figure_text("sigma", sigma, "deg") + ", " +
             figure_text("of that", relative, "deg relative to " + reference.name),
         sigma}};
  });
}

}  // namespace orbwatch::app
