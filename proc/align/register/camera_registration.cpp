// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/camera_registration.h"

#include "proc/align/register/features/feature_registration.h"
#include "proc/align/register/gradients/gradient_registration.h"
#include "proc/align/register/light/bright_spots.h"

namespace orbwatch::align {
namespace {

/// Radiometric cameras deliver 16 bits of temperature.
bool is_thermal(const Picture& picture) { return picture.format == PixelFormat::Y16; }

class Attempt {
 public:
  Attempt(const SimultaneousPictures& pictures, const optics::BallProjection& reference,
          SoughtCamera sought, const RegistrationProgress& progress)
      : pictures_(pictures), ball_(reference), sought_(std::move(sought)), progress_(progress) {
    sought_.picture = pictures_.camera.front();
  }

  Result<CameraRegistration> by_features() const {
    progress_("matching features");
    return named(register_by_features({pictures_.reference.front(), ball_}, sought_),
                 RegistrationMethod::Features);
  }
  Result<CameraRegistration> by_gradients() const {
    progress_("matching edges");
    return named(register_by_gradients({pictures_.reference.front(), ball_}, sought_),
                 RegistrationMethod::Gradients);
  }
  Result<CameraRegistration> by_light() {
    progress_("matching the process' light");
    const auto rough = register_by_light(pictures_, ball_, sought_);
    if (!rough) return tl::unexpected(rough.error());
    sought_.camera.registration = rough->rotation;
    return by_gradients();
  }
  Result<CameraRegistration> automatic() {
    if (is_thermal(pictures_.reference.front()) == is_thermal(pictures_.camera.front())) {
      return by_features();
    }
    const bool is_sequence =
        pictures_.reference.size() >= kLeastPictures && pictures_.camera.size() >= kLeastPictures;
    return is_sequence ? by_light() : by_gradients();
  }

 private:
  static Result<CameraRegistration> named(const Result<Registration>& found,
                                          RegistrationMethod method) {
    return found.map([method](const Registration& r) { return CameraRegistration{r, method}; });
  }

  const SimultaneousPictures& pictures_;
  const optics::BallProjection& ball_;
  SoughtCamera sought_;
  const RegistrationProgress& progress_;
};

}  // namespace

Result<CameraRegistration> register_camera(const SimultaneousPictures& pictures,
                                           const optics::BallProjection& reference,
                                           const SoughtCamera& sought, RegistrationMethod method,
                                           const RegistrationProgress& progress) {
  if (pictures.reference.empty() || pictures.camera.empty()) {
    return fail("a registration needs a picture of each camera");
  }
  Attempt attempt(pictures, reference, sought, progress);
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
