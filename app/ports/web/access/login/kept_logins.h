// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "app/ports/web/access/login/login_limits.h"
#include "app/ports/web/access/login/sessions.h"

/// Sessions, failed logins and familiar addresses in logins.json of the state folder, so that a
/// restart neither logs users out nor resets the limits of guessing. All reentrant; they wait for
/// the disk.
namespace orbwatch::app::web {

/// Loads the file, which may be absent. Errors: those of read_private(); the file is damaged.
Result<> load_logins(const std::filesystem::path& file, Sessions& sessions, LoginLimits& limits);

/// Saves the file. Error: that of write_private().
Result<> save_logins(const std::filesystem::path& file, const Sessions& sessions,
                     const LoginLimits& limits);

}  // namespace orbwatch::app::web
