#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "tests/support/abuse.h"

namespace orbwatch::app::web::tests {

/// The users whose passwords are guessed, and a program that may look; to be called before the
/// server starts. Returns the header by which the program is known.
std::string add_users(const std::filesystem::path& state_folder);

/// Ways to abuse the web server, which shows a view `front` and has those users.
std::span<const orbwatch::tests::Abuse> abuses();

}  // namespace orbwatch::app::web::tests
