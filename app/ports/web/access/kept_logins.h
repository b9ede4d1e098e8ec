#pragma once

#include <filesystem>

#include "app/ports/web/access/login_limits.h"
#include "app/ports/web/access/sessions.h"

/// Sessions, failed logins and familiar addresses in logins.json of the state folder, so that a
/// restart neither logs anybody out nor lets guessing begin anew. All reentrant; they wait for the
/// disk.
namespace orbwatch::app::web {

/// An absent file holds nothing. Errors: read_private(); it is damaged.
Result<> load_logins(const std::filesystem::path& file, Sessions& sessions, LoginLimits& limits);

/// Error: as write_private().
Result<> save_logins(const std::filesystem::path& file, const Sessions& sessions,
                     const LoginLimits& limits);

}  // namespace orbwatch::app::web
