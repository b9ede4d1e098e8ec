#pragma once

#include "app/dds/ros/message_type.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Every type of app/dds/idl, read from that IDL itself. Error: as read_idl(); always the same for
/// a build. Reentrant.
const Result<MessageTypes>& message_types();

}  // namespace orbwatch::app
