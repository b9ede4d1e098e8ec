// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "proc/align/register/light/light_registration.h"
#include "proc/align/register/registration.h"
#include "proc/align/work_progress.h"
#include "proc/settings/settings.h"

namespace orbwatch::align {

/// Method of registration. Auto: features where both cameras have one modality, else light where
/// there is a sequence, refined by gradients; gradients from the rig's registration as start where
/// there is none, or its light does not tell.
enum class RegistrationMethod { Auto, Features, Gradients, Light };

inline constexpr std::array kRegistrationMethods{
    Word{"auto", RegistrationMethod::Auto}, Word{"features", RegistrationMethod::Features},
    Word{"gradients", RegistrationMethod::Gradients}, Word{"light", RegistrationMethod::Light}};

struct CameraRegistration {
  Registration registration;
  RegistrationMethod method = RegistrationMethod::Auto;  ///< the last method applied, never Auto
};

/// Finds the sought camera's rotation by a method or the best sequence of methods. `pictures`: of
/// fixed cameras, one each at least; methods other than light use the first ones. Light alone is
/// accurate to some degrees only, so that Light, too, is refined by gradients. Reentrant. Error:
/// those of the methods tried; light that several rotations explain, whose edges agree, too;
/// cancelled by `progress`.
Result<CameraRegistration> register_camera(const SimultaneousPictures& pictures,
                                           const optics::BallProjection& reference,
                                           const SoughtCamera& sought, RegistrationMethod method,
                                           const WorkProgress& progress);

}  // namespace orbwatch::align
