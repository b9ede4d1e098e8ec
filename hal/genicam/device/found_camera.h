#pragma once

#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// A camera that answers in the network or on USB. Texts come from devices and may contain
/// anything.
struct FoundCamera {
  std::string id;  ///< maker, model and serial number, as Aravis joins them
  std::string model;
  std::string serial;
  std::string name;      ///< that its user gave to it; may be empty
  std::string address;   ///< IP address, or place on the USB
  std::string protocol;  ///< "GigEVision", "USB3Vision"

  bool is_gige() const { return protocol == "GigEVision"; }
};

/// Asks all networks and USB; takes about a second. Disturbs no stream. Thread-safe.
std::vector<FoundCamera> find_cameras();

/// The camera whose id, serial number, name or address is `wanted`. The error lists what there is.
/// Reentrant.
Result<FoundCamera> choose_found_camera(const std::vector<FoundCamera>& cameras,
                                        const std::string& wanted);

/// The camera that `wanted` names: where `known`, of an earlier call, or an IP address answers as
/// the same camera, without a search. Error: it does not answer, or several do. Thread-safe.
Result<FoundCamera> find_camera_again(const std::string& wanted, const FoundCamera& known);

}  // namespace orbwatch::hal
