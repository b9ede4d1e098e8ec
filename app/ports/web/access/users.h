#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/role.h"
#include "proc/image/result.h"

/// Who may log in: users.json of the state folder.
namespace orbwatch::app::web {

struct User {
  std::string name;
  Role role = Role::Viewer;
  std::string password;  ///< its hash_password()
};

/// Of a program instead of a person.
struct ApiToken {
  std::string name;
  Role role = Role::Viewer;
  std::string hash;  ///< its token_hash()
};

struct Users {
  std::vector<User> users;
  std::vector<ApiToken> tokens;

  /// Null: there is none of that name.
  const User* find(std::string_view name) const;
  const ApiToken* find_token(std::string_view hash) const;
};

/// The administrator who is there first, unless another name is chosen.
inline constexpr std::string_view kFirstUser = "admin";

inline constexpr std::size_t kMostUsers = 64;  ///< and as many tokens

std::filesystem::path users_file(const std::filesystem::path& state_folder);

/// "viewer, operator, ..." is right; the error says so.
Result<Role> parse_role(std::string_view name);

/// Of a person or a program: 1 to 32 small letters, digits, '.', '-' and '_'.
Result<> check_name(std::string_view name);

/// The file's text, and back. Errors: it is damaged; a name, role or hash is not one, or occurs
/// twice; nobody is administrator; too many.
std::string users_text(const Users& users);
Result<Users> parse_users(std::string_view text);

/// Nullopt: nobody has set a password yet. Errors: as read_private() and parse_users(); the file is
/// absent although it is kept that users exist.
Result<std::optional<Users>> load_users(const std::filesystem::path& file);

/// Keeps beside the file that users exist, so that a file that is lost later is a fault. Error: as
/// write_private().
Result<> keep_that_users_exist(const std::filesystem::path& file);

/// Changes the file, no matter which process does so meanwhile; an absent one holds nobody. Keeps
/// that users exist. Errors: those of `change`, as read_private() and parse_users(), the result is
/// no valid file, write_private().
Result<> change_users(const std::filesystem::path& file,
                      const std::function<Result<>(Users&)>& change);

/// Adds a user or changes one: `hash` empty keeps the password, `role` nullopt the role. Errors: a
/// new one has no password; the name is none.
Result<> set_user(Users& users, const std::string& name, std::optional<Role> role,
                  const std::string& hash);

}  // namespace orbwatch::app::web
