#pragma once

#include <string>

#include "app/dds/idl/alarm_event.h"
#include "app/dds/time_message.h"
#include "app/pipeline/status.h"
#include "app/pipeline/status_names.h"

namespace orbwatch::app {

using AlarmEventMessage = orbwatch_msgs_msg_dds__AlarmEvent_;

/// A notice for operators in one line, as in "weld: hot_spot_width raised, high alarm, 3.2 mm".
/// Reentrant.
std::string notice_text(const AlarmNotice& notice, const StatusNames& names);

/// The message of a notice; `stamp` is the notice's in UTC. It leads to `text`, which has to
/// outlive it. Reentrant.
AlarmEventMessage event_message(const AlarmNotice& notice, const TimeMessage& stamp,
                                std::string& text);

}  // namespace orbwatch::app
