#pragma once

#include <array>
#include <functional>
#include <string>

#include "proc/align/register/light_registration.h"
#include "proc/align/register/registration.h"
#include "proc/settings/settings.h"

namespace orbwatch::align {

/// What a rotation is found by. Auto: features where both cameras are of one modality, else light
/// where there is a sequence, refined by gradients, else gradients from the start in the rig.
enum class RegistrationMethod { Auto, Features, Gradients, Light };

inline constexpr std::array kRegistrationMethods{
    Word{"auto", RegistrationMethod::Auto}, Word{"features", RegistrationMethod::Features},
    Word{"gradients", RegistrationMethod::Gradients}, Word{"light", RegistrationMethod::Light}};

struct CameraRegistration {
  Registration registration;
  RegistrationMethod method = RegistrationMethod::Auto;  ///< the last one, never Auto
};

/// Called with what is going to be done, for people who wait.
using RegistrationProgress = std::function<void(const std::string&)>;

/// The sought camera's rotation by a method or the best sequence of methods. `pictures`: of fixed
/// cameras, one each at least; what is no process light is looked at in the first ones. Light alone
/// is right to some degrees only, so that Light, too, is refined by gradients. Reentrant. Error:
/// those of the method that was last tried.
Result<CameraRegistration> register_camera(const SimultaneousPictures& pictures,
                                           const optics::BallProjection& reference,
                                           const SoughtCamera& sought, RegistrationMethod method,
                                           const RegistrationProgress& progress);

}  // namespace orbwatch::align
