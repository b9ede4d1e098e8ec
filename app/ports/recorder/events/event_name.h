// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "app/ports/recorder/events/event_triggers.h"
#include "app/ports/recorder/messages.h"

namespace orbwatch::app::recorder {

/// Folder of an event: 20261128T092200.125Z-alarm, by the moment of its trigger. Reentrant.
std::string event_name(Utc triggered, TriggerKind trigger);

/// True for such a name, with a number behind it or not: -2. Reentrant.
bool is_event_name(std::string_view name);

}  // namespace orbwatch::app::recorder
