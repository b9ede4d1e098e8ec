// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/access_desk.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "app/ports/web/access/login/secret.h"

namespace orbwatch::app::web {
namespace {

std::string cookie(const Request& request, const std::string& token, std::chrono::seconds age) {
  return std::string(session_cookie(request)) + "=" + token + "; Path=" + request.prefix +
         "/; HttpOnly; SameSite=Strict; Max-Age=" + std::to_string(age.count()) +
         (request.is_secure ? "; Secure" : "");
}

/// Text such as "kim: viewer".
std::string with_role(const std::string& name, Role role) {
  return name + ": " + std::string(word_for(kRoles, role));
}

/// Removes the entry of this name. Error: unknown name.
template <class One>
Result<> remove(std::vector<One>& all, const std::string& name, const char* what) {
  if (std::erase_if(all, [&](const One& one) { return one.name == name; }) > 0) return {};
  return fail(std::string("there is no ") + what + " " + name);
}

}  // namespace

void AccessDesk::audit(const ExchangePtr& exchange) {
  constexpr std::size_t kMostShown = 500;
  changes_.read(exchange, [this] {
    audit_.write_all();
    return json_response(json_text({{"entries", audit_.newest(kMostShown)}}));
  });
}

/// Text such as "kim: viewer"; empty: unknown user.
std::string AccessDesk::role_of(const std::string& user) const {
  const Users all = access_.users();
  const User* found = all.find(user);
  return found ? with_role(user, found->role) : "";
}

Answered<SessionAnswer> AccessDesk::session(const Request& request) const {
  const Caller caller = access_.caller(credentials_of(request));
  SessionAnswer session{caller.name, word_for(kRoles, caller.role), {}};
  for (const auto& role : kRoles) {
    if (role.value <= caller.role) session.roles.push_back(role.name);
  }
  session.has_users = access_.has_users();
  return session;
}

Answered<Users> AccessDesk::users() const { return access_.users(); }

Answered<Done> AccessDesk::logged_in(ChangeRequest& change, const Access::Token& token) const {
  if (!token) return tl::unexpected(refused(token.error()));
  change.headers.emplace_back("Set-Cookie", cookie(change.request, *token, longest_));
  return Done{};
}

// Only a known name is recorded, because a password may have been typed as the name.
std::optional<Access::Refusal> AccessDesk::refuse_login(Change<LoginBody>& change) const {
  change.after = role_of(change.body.user);
  return access_.login_refusal(change.body.user, client_address(change.request));
}

std::optional<Access::Refusal> AccessDesk::refuse_first_password(
    Change<FirstPasswordBody>& change) const {
  return access_.first_password_refusal(client_address(change.request));
}

Answered<Done> AccessDesk::login(Change<LoginBody>& change) {
  const std::string& user = change.body.user;
  const auto token = access_.login(user, change.body.password, client_address(change.request));
  if (token) change.caller.name = user;
  change.after = role_of(user);
  return logged_in(change, token);
}

Answered<Done> AccessDesk::logout(Change<Nothing>& change) {
  const std::string* session = change.request.cookie(session_cookie(change.request));
  change.changes_nothing = !session || !access_.logout(*session);
  change.headers.emplace_back("Set-Cookie", cookie(change.request, "", std::chrono::seconds(0)));
  return Done{};
}

Answered<Done> AccessDesk::set_password(Change<PasswordBody>& change) {
  const PasswordBody& body = change.body;
  return logged_in(change,
                   access_.change_password(change.caller.name, body.old_password, body.new_password,
                                           client_address(change.request)));
}

Answered<Done> AccessDesk::set_first_password(Change<FirstPasswordBody>& change) {
  const auto token = access_.set_first_password(change.body.code, change.body.password,
                                                client_address(change.request));
  if (token) {
    change.caller.name = kFirstUser;
    change.after = role_of(change.caller.name);
  }
  return logged_in(change, token);
}

/// Trust in this computer ends with the first password, which may be set meanwhile.
Answered<Done> AccessDesk::change_users(const ChangeRequest& change,
                                        const std::function<Result<>(Users&)>& edit) {
  const auto changed = access_.change([&](Users& all) -> Result<> {
    if (change.caller.name.empty() && !all.users.empty()) {
      return fail("a password has been set meanwhile; log in");
    }
    return edit(all);
  });
  if (!changed) return refuse(changed.error());
  return Done{};
}

Answered<Done> AccessDesk::set_user(Change<UserBody>& change) {
  const UserBody& body = change.body;
  std::string hash;
  if (!body.password.empty()) {
    if (auto right = check_password(body.password); !right) return refuse(right.error(), 400);
    auto hashed = hash_password(body.password);
    if (!hashed) return refuse(hashed.error(), 503);
    hash = std::move(*hashed);
  }
  change.before = role_of(body.user);
  const auto changed = change_users(
      change, [&](Users& all) { return web::set_user(all, body.user, body.role, hash); });
  if (changed) change.after = role_of(body.user) + (hash.empty() ? "" : ", another password");
  return changed;
}

Answered<Done> AccessDesk::remove_user(Change<UserNameBody>& change) {
  const std::string& user = change.body.user;
  change.before = role_of(user);
  return change_users(change, [&](Users& all) { return remove(all.users, user, "user"); });
}

Answered<TokenAnswer> AccessDesk::create_token(Change<TokenBody>& change) {
  const auto& [name, role] = change.body;
  if (auto named = check_name(name); !named) return refuse(named.error(), 400);
  const std::string token = random_token();
  const ApiToken added{name, role, token_hash(token)};
  const auto changed = change_users(change, [&](Users& all) -> Result<> {
    if (std::ranges::find(all.tokens, added.name, &ApiToken::name) != all.tokens.end()) {
      return fail("there is a token " + added.name + " already; revoke it first");
    }
    all.tokens.push_back(added);
    return {};
  });
  if (changed) change.after = with_role(name, role);
  return changed.map([&](const Done&) { return TokenAnswer{token}; });
}

Answered<Done> AccessDesk::revoke_token(Change<TokenNameBody>& change) {
  const std::string& name = change.body.name;
  const auto removed =
      change_users(change, [&](Users& all) { return remove(all.tokens, name, "token"); });
  if (removed) change.before = name;
  return removed;
}

}  // namespace orbwatch::app::web
