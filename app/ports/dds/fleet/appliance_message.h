#pragma once

#include "app/model/appliance_notice.h"
#include "app/ports/dds/generated/appliance.h"
#include "proc/image/result.h"

namespace orbwatch::app {

using ApplianceMessage = orbwatch_msgs_msg_dds__Appliance_;
using ThumbnailMessage = orbwatch_msgs_msg_dds__Thumbnail_;

/// The notice as a message. Longer texts are cut. Reentrant.
ApplianceMessage appliance_message(const ApplianceNotice& notice);

/// What a message from the network says: its texts are safe to show, its page leads to a numeric
/// address or nowhere. Errors: an unknown system state or severity. Reentrant.
Result<ApplianceNotice> check_appliance(const ApplianceMessage& message);

/// Checks a picture from the network. Errors: no JPEG, damaged, larger than
/// Thumbnail::kLongestSide. Reentrant.
Result<> check_thumbnail(const ThumbnailMessage& message);

}  // namespace orbwatch::app
