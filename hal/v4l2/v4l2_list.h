#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hal/inventory.h"
#include "hal/v4l2/v4l2_device.h"

namespace orbwatch::hal {

/// What one device says of itself; its links are not known then. Disturbs no stream.
CameraEntry describe(const V4l2Device& device);

/// All devices in `folder` that capture pictures, in the order of their numbers; those that cannot
/// be opened, too. The id is a link in v4l/by-id or by-path if there is one, else the node.
/// Reentrant.
std::vector<CameraEntry> list_v4l2_cameras(const std::filesystem::path& folder = "/dev");

/// The device node that `name` means: a path, which is taken as it is; the name of a link in
/// v4l/by-id or v4l/by-path of `folder`; or a place on a bus as the driver tells it
/// ("usb-0000:00:14.0-1", "platform:vivid-000"). Fault::Unplugged when there is none. Reentrant.
DeviceResult<std::string> find_v4l2_device(const std::string& name,
                                           const std::filesystem::path& folder = "/dev");

}  // namespace orbwatch::hal
