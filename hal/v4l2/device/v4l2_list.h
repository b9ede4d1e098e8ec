// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hal/inventory.h"
#include "hal/v4l2/device/v4l2_device.h"

namespace orbwatch::hal {

/// Describes a device by its own data, without its links. Disturbs no stream.
CameraEntry describe(const V4l2Device& device);

/// All devices in `folder` that capture pictures, by number, including those that cannot be opened.
/// The id is a link in v4l/by-id or by-path if it exists, else the node. Reentrant.
std::vector<CameraEntry> list_v4l2_cameras(const std::filesystem::path& folder = "/dev");

/// Device node of `name`: a path, returned unchanged; the name of a link in v4l/by-id or
/// v4l/by-path of `folder`; or the driver's bus address ("usb-0000:00:14.0-1",
/// "platform:vivid-000"). Fault::Unplugged when it does not exist. Reentrant.
DeviceResult<std::string> find_v4l2_device(const std::string& name,
                                           const std::filesystem::path& folder = "/dev");

}  // namespace orbwatch::hal
