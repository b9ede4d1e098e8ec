// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "app/cli/options/options.h"
#include "app/ports/dds/security/participant_security.h"

namespace orbwatch::app::cli {

/// Options for domain and topics of the orbwatchd that a command communicates with.
Option domain_option(int& domain);
Option prefix_option(std::string& prefix);

/// Option for the keys of an orbwatchd with [dds.security].
Option security_option(std::optional<dds::SecuritySettings>& security);

/// Option for the limit of the wait for an answer.
Option timeout_option(std::chrono::milliseconds& timeout);

}  // namespace orbwatch::app::cli
