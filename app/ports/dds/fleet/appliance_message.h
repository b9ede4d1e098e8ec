// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/model/fleet/appliance_notice.h"
#include "app/ports/dds/generated/appliance.h"
#include "proc/image/result.h"

namespace orbwatch::app::dds {

using ApplianceMessage = orbwatch_msgs_msg_dds__Appliance_;
using ThumbnailMessage = orbwatch_msgs_msg_dds__Thumbnail_;

/// The notice as a message. Longer texts are cut. Reentrant.
ApplianceMessage appliance_message(const ApplianceNotice& notice);

/// Converts a message from the network: its texts are made safe for display, its page address is
/// numeric or empty. Errors: an unknown system state or severity. Reentrant.
Result<ApplianceNotice> check_appliance(const ApplianceMessage& message);

/// Checks a picture from the network. Errors: not a JPEG, damaged, or larger than
/// Thumbnail::kLongestSide. Reentrant.
Result<> check_thumbnail(const ThumbnailMessage& message);

}  // namespace orbwatch::app::dds
