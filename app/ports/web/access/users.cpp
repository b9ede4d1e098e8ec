// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/users.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "app/state/private_file.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostNameBytes = 32;
constexpr int kVersion = 1;

/// Text of a member; empty: missing, or not a string.
std::string text_of(const Json& object, const char* member) {
  const auto found = object.is_object() ? object.find(member) : object.end();
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// Reads the list `kind` of users or programs; `secret` names the member with the hash.
template <class One>
Result<std::vector<One>> parse_all(const Json& all, const char* kind, const char* secret_name,
                                   std::string One::*secret) {
  const auto listed = all.find(kind);
  if (listed == all.end() || !listed->is_array()) {
    return fail(std::string("has no list of ") + kind);
  }
  if (listed->size() > kMostUsers) {
    return fail("has more than " + std::to_string(kMostUsers) + " " + kind);
  }
  std::vector<One> parsed;
  std::set<std::string> names;
  for (const Json& one : *listed) {
    One made;
    made.name = text_of(one, "name");
    if (auto named = check_name(made.name); !named) return tl::unexpected(named.error());
    if (!names.insert(made.name).second) return fail(made.name + " occurs twice");
    const auto role = parse_role(text_of(one, "role"));
    if (!role) return tl::unexpected(role.error());
    made.role = *role;
    made.*secret = text_of(one, secret_name);
    if ((made.*secret).empty()) return fail(made.name + " has no " + secret_name);
    parsed.push_back(std::move(made));
  }
  return parsed;
}

template <class One>
Json list_of(const std::vector<One>& all, const char* secret_name, std::string One::*secret) {
  Json list = Json::array();
  for (const One& one : all) {
    list.push_back({{"name", one.name},
                    {"role", std::string(word_for(kRoles, one.role))},
                    {secret_name, one.*secret}});
  }
  return list;
}

std::filesystem::path marker_of(const std::filesystem::path& file) {
  return file.parent_path() / "password-is-set";
}

/// Reads the file; nullopt: there is none.
Result<std::optional<Users>> read_users(const std::filesystem::path& file) {
  const auto text = read_private(file);
  if (!text) return tl::unexpected(text.error());
  if (!*text) return std::nullopt;
  auto users = parse_users(**text);
  if (!users) return fail(file.string() + ": " + users.error().message);
  return std::move(*users);
}

}  // namespace

const User* Users::find(std::string_view name) const {
  const auto found = std::ranges::find(users, name, &User::name);
  return found == users.end() ? nullptr : &*found;
}

const ApiToken* Users::find_token(std::string_view hash) const {
  const auto found = std::ranges::find(tokens, hash, &ApiToken::hash);
  return found == tokens.end() ? nullptr : &*found;
}

std::filesystem::path users_file(const std::filesystem::path& state_folder) {
  return state_folder / "users.json";
}

Result<Role> parse_role(std::string_view name) {
  if (const Role* role = find_word(kRoles, name)) return *role;
  return fail("unknown role; it must be one of: " + joined(kRoles));
}

Result<> check_name(std::string_view name) {
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
  };
  if (!name.empty() && name.size() <= kMostNameBytes && std::ranges::all_of(name, is_allowed)) {
    return {};
  }
  return fail("a name must be 1 to " + std::to_string(kMostNameBytes) +
              " lower-case letters, digits, '.', '-' and '_'");
}

std::string users_text(const Users& users) {
  return Json{{"version", kVersion},
              {"users", list_of(users.users, "password", &User::password)},
              {"tokens", list_of(users.tokens, "hash", &ApiToken::hash)}}
             .dump(1) +
         "\n";
}

Result<Users> parse_users(std::string_view text) {
  const Json all = Json::parse(text, nullptr, false);
  if (!all.is_object() || all.value("version", Json()) != kVersion) {
    return fail("is damaged, or of another version than " + std::to_string(kVersion));
  }
  auto users = parse_all(all, "users", "password", &User::password);
  if (!users) return tl::unexpected(users.error());
  auto tokens = parse_all(all, "tokens", "hash", &ApiToken::hash);
  if (!tokens) return tl::unexpected(tokens.error());
  if (std::ranges::find(*users, Role::Administrator, &User::role) == users->end()) {
    return fail("at least one user must be administrator");
  }
  return Users{std::move(*users), std::move(*tokens)};
}

Result<std::optional<Users>> load_users(const std::filesystem::path& file) {
  auto users = read_users(file);
  if (!users || *users) return users;
  const auto marker = read_private(marker_of(file));
  if (!marker) return tl::unexpected(marker.error());
  if (!*marker) return std::nullopt;
  return fail(
      file.string() +
      ": is missing, although a password was set; set one by `sudo orbwatch password`, or remove " +
      marker_of(file).string() + " as well to start without users");
}

Result<> keep_that_users_exist(const std::filesystem::path& file) {
  const auto marker = read_private(marker_of(file));
  if (marker && *marker) return {};
  return write_private(marker_of(file), "users.json exists; without it no user is admitted\n");
}

Result<> change_users(const std::filesystem::path& file,
                      const std::function<Result<>(Users&)>& change) {
  return with_lock(file, [&]() -> Result<> {
    auto loaded = read_users(file);
    if (!loaded) return tl::unexpected(loaded.error());
    Users users = loaded->value_or(Users{});
    if (auto changed = change(users); !changed) return changed;
    const std::string text = users_text(users);
    if (const auto valid = parse_users(text); !valid) return tl::unexpected(valid.error());
    if (auto written = write_private(file, text); !written) return written;
    return keep_that_users_exist(file);
  });
}

Result<> set_user(Users& users, const std::string& name, std::optional<Role> role,
                  const std::string& hash) {
  if (auto named = check_name(name); !named) return named;
  auto found = std::ranges::find(users.users, name, &User::name);
  if (found == users.users.end()) {
    if (hash.empty()) return fail("there is no user " + name + "; a new one needs a password");
    found = users.users.insert(found, {name, Role::Viewer, hash});
  }
  if (role) found->role = *role;
  if (!hash.empty()) found->password = hash;
  return {};
}

}  // namespace orbwatch::app::web
