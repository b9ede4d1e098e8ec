// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "proc/align/register/camera_registration.h"

namespace orbwatch::app::cli {

/// Two cameras of a rig, and the second one's registration to the first.
struct RegisteredCamera {
  std::string reference;
  std::string camera;
  align::CameraRegistration found;
};

/// For people: the rotation, how sure it is, and the keys of the rig file that state it.
std::string register_text(const RegisteredCamera& camera);

/// One JSON object (RFC 8259), as documented in `orbwatch register --help`.
std::string register_json(const RegisteredCamera& camera);

}  // namespace orbwatch::app::cli
