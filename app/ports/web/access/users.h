// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/command/role.h"
#include "proc/image/result.h"

/// Users and programs that may log in: users.json of the state folder.
namespace orbwatch::app::web {

struct User {
  std::string name;
  Role role = Role::Viewer;
  std::string password;  ///< the hash_password() of the password
};

/// Token of a program.
struct ApiToken {
  std::string name;
  Role role = Role::Viewer;
  std::string hash;  ///< the token_hash() of the token
};

struct Users {
  std::vector<User> users;
  std::vector<ApiToken> tokens;

  /// The user of this name; null: unknown.
  const User* find(std::string_view name) const;
  const ApiToken* find_token(std::string_view hash) const;
};

/// Default name of the first administrator.
inline constexpr std::string_view kFirstUser = "admin";

inline constexpr std::size_t kMostUsers = 64;  ///< also the limit of tokens

std::filesystem::path users_file(const std::filesystem::path& state_folder);

/// Parses a role's name. Error: unknown, with the list of names.
Result<Role> parse_role(std::string_view name);

/// Checks the name of a user or a program: 1 to 32 lower-case letters, digits, '.', '-' and '_'.
Result<> check_name(std::string_view name);

/// Writes and parses the file's text. Errors: damaged; an invalid or repeated name, role or hash;
/// no administrator; too many entries.
std::string users_text(const Users& users);
Result<Users> parse_users(std::string_view text);

/// Loads the users; nullopt: no password is set yet. Errors: those of read_private() and
/// parse_users(); the file is absent although the marker for existing users is present.
Result<std::optional<Users>> load_users(const std::filesystem::path& file);

/// Writes a marker beside the file that users exist, so that a later loss of the file is a fault.
/// Error: that of write_private().
Result<> keep_that_users_exist(const std::filesystem::path& file);

/// Changes the file, safely against other processes; an absent file means no users. Writes the
/// marker. Errors: those of `change`, read_private(), parse_users() and write_private(); the result
/// is not a valid file.
Result<> change_users(const std::filesystem::path& file,
                      const std::function<Result<>(Users&)>& change);

/// Adds or changes a user: `hash` empty keeps the password, `role` nullopt the role. Errors: a new
/// user without a password; an invalid name.
Result<> set_user(Users& users, const std::string& name, std::optional<Role> role,
                  const std::string& hash);

}  // namespace orbwatch::app::web
