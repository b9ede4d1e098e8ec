// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "tests/support/abuse.h"

namespace orbwatch::app::web::tests {

/// Adds the users whose passwords are guessed, and a program with the role viewer; to be called
/// before the server starts. Returns the header with the program's token.
std::string add_users(const std::filesystem::path& state_folder);

/// Ways to abuse the web server, which has a view `front` and those users.
std::span<const orbwatch::tests::Abuse> abuses();

}  // namespace orbwatch::app::web::tests
