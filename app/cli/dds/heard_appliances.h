// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <optional>

#include "app/model/fleet/fleet.h"
#include "app/ports/dds/security/participant_security.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// Joins the domain, with `security` if the appliances have it, and fills `fleet` for `duration`,
/// or until `cancelled`, which is checked ten times a second. Thread-bound. Errors: as
/// Participant::join, DDS refuses.
Result<> hear_appliances(int domain, const std::optional<dds::SecuritySettings>& security,
                         std::chrono::nanoseconds duration, const std::atomic<bool>& cancelled,
                         Fleet& fleet);

}  // namespace orbwatch::app::cli
