#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "app/cli/options.h"
#include "app/dds/security/participant_security.h"

namespace orbwatch::app {

/// Where the orbwatchd is that a command talks to.
Option domain_option(int& domain);
Option prefix_option(std::string& prefix);

/// With what it talks to one that has [dds.security].
Option security_option(std::optional<SecuritySettings>& security);

/// How long to wait for it.
Option timeout_option(std::chrono::milliseconds& timeout);

}  // namespace orbwatch::app
