// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/certificates/dates.h"
#include "app/daemon/site/site_plan.h"
#include "app/files/resolve.h"
#include "app/model/sink/listening_port.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// The TCP ports of all enabled interfaces, without those that are any free one. Reentrant.
std::vector<ListeningPort> listening_ports(const files::SinkSettings& sinks);

/// Error: two interfaces would listen on one port.
Result<> check_ports(const files::Resolved& site);

/// Checks keys and certificates of the enabled interfaces, as far as files are named.
Result<> check_keys(const files::Resolved& site, Dates dates);

/// Checks that what the enabled interfaces record fits their memory, as far as the cameras' formats
/// are known.
Result<> check_recordings(const files::Resolved& site);

/// Plans the site for the formats that are expected, and checks what build() would refuse, the
/// interfaces, and that each camera and line is used once. Opens no camera and no line; compiles no
/// view and allocates no picture, so that it may run beside the site.
Result<SitePlan> checked_plan(const files::Resolved& site, Dates dates);

/// The same for callers that need no plan.
Result<> check_site(const files::Resolved& site, Dates dates);

}  // namespace orbwatch::app::daemon
