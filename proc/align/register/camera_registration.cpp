// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/camera_registration.h"

#include <optional>
#include <string>

#include "proc/align/register/features/feature_registration.h"
#include "proc/align/register/gradients/gradient_registration.h"
#include "proc/align/register/light/bright_spots.h"
#include "proc/align/rotation_fit.h"

namespace orbwatch::align {
namespace {

const double kOneRotation = optics::radians(1.5);  // angle between refined rotations that are one

/// Radiometric cameras deliver 16 bits of temperature.
bool is_thermal(const Picture& picture) { return picture.format == PixelFormat::Y16; }

class Attempt {
 public:
  Attempt(const SimultaneousPictures& pictures, const optics::BallProjection& reference,
          SoughtCamera sought, const WorkProgress& progress)
      : pictures_(pictures), ball_(reference), sought_(std::move(sought)), progress_(progress) {
    sought_.picture = pictures_.camera.front();
  }

  Result<CameraRegistration> by_features() const {
    return named(register_by_features({pictures_.reference.front(), ball_}, sought_, progress_),
                 RegistrationMethod::Features);
  }
  Result<CameraRegistration> by_gradients() const {
    return by_gradients(sought_.camera.registration);
  }
  /// Refines each rotation that explains the light; the one on which edges agree is right.
  Result<CameraRegistration> by_light() const {
    if (auto wanted = progress_.at(WorkStep::Light); !wanted) return tl::unexpected(wanted.error());
    const auto rough = register_by_light(pictures_, ball_, sought_);
    if (!rough) return tl::unexpected(rough.error());
    std::optional<CameraRegistration> found;
    std::string refusal;
    for (const Registration& start : *rough) {
      const auto fine = by_gradients(start.rotation);
      if (!fine) {
        if (refusal.empty()) refusal = fine.error().message;
      } else if (!found) {
        found = *fine;
      } else if (angle_between(fine->registration.rotation, found->registration.rotation) >
                 kOneRotation) {
        return fail(
            "two different rotations explain the process' light and the edges nearly as well");
      }
    }
    if (!found) return fail(refusal);
    return *found;
  }
  Result<CameraRegistration> automatic() const {
    if (is_thermal(pictures_.reference.front()) == is_thermal(pictures_.camera.front())) {
      return by_features();
    }
    const bool is_sequence =
        pictures_.reference.size() >= kLeastPictures && pictures_.camera.size() >= kLeastPictures;
    if (!is_sequence) return by_gradients();
    const auto by_sparks = by_light();
    if (by_sparks) return by_sparks;
    return by_gradients().map_error([&](const auto& error) {
      return Error{by_sparks.error().message + "; from the rig's registration: " + error.message};
    });
  }

 private:
  Result<CameraRegistration> by_gradients(const optics::Mat3& start) const {
    SoughtCamera near = sought_;
    near.camera.registration = start;
    return named(register_by_gradients({pictures_.reference.front(), ball_}, near, progress_),
                 RegistrationMethod::Gradients);
  }
  static Result<CameraRegistration> named(const Result<Registration>& found,
                                          RegistrationMethod method) {
    return found.map([method](const Registration& r) { return CameraRegistration{r, method}; });
  }

  const SimultaneousPictures& pictures_;
  const optics::BallProjection& ball_;
  SoughtCamera sought_;
  const WorkProgress& progress_;
};

}  // namespace

Result<CameraRegistration> register_camera(const SimultaneousPictures& pictures,
                                           const optics::BallProjection& reference,
                                           const SoughtCamera& sought, RegistrationMethod method,
                                           const WorkProgress& progress) {
  if (pictures.reference.empty() || pictures.camera.empty()) {
    return fail("a registration needs a picture of each camera");
  }
  const Attempt attempt(pictures, reference, sought, progress);
  switch (method) {
    case RegistrationMethod::Features:
      return attempt.by_features();
    case RegistrationMethod::Gradients:
      return attempt.by_gradients();
    case RegistrationMethod::Light:
      return attempt.by_light();
    case RegistrationMethod::Auto:
      break;
  }
  return attempt.automatic();
}

}  // namespace orbwatch::align
