// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// A camera that answers in the network or on USB. Texts come from devices and may contain
/// anything.
struct FoundCamera {
  std::string id;  ///< maker, model and serial number, joined by Aravis
  std::string model;
  std::string serial;
  std::string name;      ///< name given by its user; may be empty
  std::string address;   ///< IP address, or place on the USB
  std::string protocol;  ///< "GigEVision", "USB3Vision"

  bool is_gige() const { return protocol == "GigEVision"; }
};

/// Searches all networks and USB; takes about a second. Disturbs no stream. Thread-safe.
std::vector<FoundCamera> find_cameras();

/// The camera whose id, serial number, name or address is `wanted`. The error lists the cameras
/// found. Reentrant.
Result<FoundCamera> choose_found_camera(const std::vector<FoundCamera>& cameras,
                                        const std::string& wanted);

/// Finds the camera that `wanted` names without a search, if the same camera answers at the address
/// of `known`, from an earlier call, or at an IP address. Error: it does not answer, or several do.
/// Thread-safe.
Result<FoundCamera> find_camera_again(const std::string& wanted, const FoundCamera& known);

}  // namespace orbwatch::hal
