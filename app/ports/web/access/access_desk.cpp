// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/access_desk.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/ports/web/access/secret.h"
#include "app/ports/web/http/address.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kOk = 200, kTooManyRequests = 429, kUnavailable = 503;

Response done() { return json_response(R"({"result_text":"done"})"); }

Response done_or(const Result<>& result) {
  return result ? done() : error_response(409, result.error().message);
}

std::string cookie(const web::Request& request, const std::string& token,
                   std::chrono::seconds age) {
  return std::string(session_cookie(request)) + "=" + token + "; Path=" + request.prefix +
         "/; HttpOnly; SameSite=Strict; Max-Age=" + std::to_string(age.count()) +
         (request.is_secure ? "; Secure" : "");
}

template <class One>
Json list_of(const std::vector<One>& all) {
  Json list = Json::array();
  for (const One& one : all) {
    list.push_back({{"name", one.name}, {"role", std::string(word_for(kRoles, one.role))}});
  }
  return list;
}

/// Removes the entry of this name. Error: unknown name.
template <class One>
Result<> remove(std::vector<One>& all, const std::string& name, const char* what) {
  if (std::erase_if(all, [&](const One& one) { return one.name == name; }) > 0) return {};
  return fail(std::string("there is no ") + what + " " + name);
}

}  // namespace

Response refused(const Access::Refusal& refusal) {
  Response response = error_response(refusal.status, refusal.what);
  if (refusal.retry_after.count() > 0) {
    response.headers.emplace_back("Retry-After", std::to_string(refusal.retry_after.count()));
  }
  return response;
}

Route AccessDesk::changing(const char* path, Role role, const char* description,
                           std::vector<BodyMember> body, Handler handler, Refuse refuse) {
  const Task task{role, handler, refuse};
  Route route{"POST", path, role, description, std::string(kJson), {}};
  route.body = body;
  route.serve = [this, task, body = std::move(body)](const ExchangePtr& exchange) {
    auto members = parse_members(body, exchange->request().body);
    if (!members) {
      exchange->answer(error_response(400, members.error().message));
      return;
    }
    receive(exchange, std::move(*members), task);
  };
  return route;
}

/// Receives a request, on a thread of the server; does not wait.
void AccessDesk::receive(const ExchangePtr& exchange, Members members, const Task& task) {
  const web::Request& sent = exchange->request();
  if (task.refuse) {
    Request request{sent, members, ""};
    if (const auto refusal = (this->*task.refuse)(request)) {
      exchange->answer(refuse_unknown(request, *refusal));
      return;
    }
  }
  const SlowWork::Asker asker = this->asker(sent, members);
  work_.run(exchange, asker, [this, task, exchange, members = std::move(members)] {
    return answer_and_note(exchange, members, task);
  });
}

Audit::Entry AccessDesk::entry_of(const Request& request, bool is_done) {
  const std::string& path = request.sent.path;
  return {std::chrono::system_clock::now(), request.user,   client_address(request.sent),
          path.substr(path.rfind('/') + 1), request.before, request.after,
          is_done ? "done" : "refused"};
}

/// Refusal for a caller without a role. A 503 is a fault of the appliance and does not count as an
/// attempt.
Response AccessDesk::refuse_unknown(Request& request, const Access::Refusal& refusal) {
  constexpr std::uint64_t kMostRefused = 20;
  if (refusal.status == kUnavailable) return refused(refusal);
  const auto count = audit_.note_refused(entry_of(request, false));
  if (count <= kMostRefused || refusal.status == kTooManyRequests) return refused(refusal);
  const std::chrono::seconds wait = Repetitions::kPeriod;
  return refused({kTooManyRequests,
                  "too many refused requests from this address; try again in " +
                      std::to_string(wait.count()) + " s",
                  wait});
}

/// Client in the queues. A user does not wait behind guesses of others at an address from which the
/// user has logged in before.
SlowWork::Asker AccessDesk::asker(const web::Request& sent, const Members& members) const {
  const Caller caller = access_.caller(credentials_of(sent));
  if (caller.role != Role::Nobody) return {true, caller.name};
  const std::string address = address_key(client_address(sent));
  const auto user = members.find("user");
  return {user != members.end() && access_.is_familiar(user->second, client_address(sent)),
          address};
}

/// The role is checked again, because the request may have waited.
Response AccessDesk::answer_and_note(const ExchangePtr& exchange, const Members& members,
                                     const Task& task) {
  const web::Request& sent = exchange->request();
  access_.refresh();
  const Caller caller = access_.caller(credentials_of(sent));
  if (caller.role < task.role) {
    return error_response(401, "the required role has expired; log in again");
  }
  Request request{sent, members, caller.name};
  Response response = (this->*task.handler)(request);
  note(request, task, response.status);
  return response;
}

/// Requests refused for their rate are counted if they come without a role, and otherwise not
/// recorded, because they would displace all other entries.
void AccessDesk::note(const Request& request, const Task& task, int status) {
  if (status == kUnavailable || request.changes_nothing) return;
  if (task.role == Role::Nobody && status != kOk) {
    audit_.note_refused(entry_of(request, false));
  } else if (status != kTooManyRequests) {
    audit_.note(entry_of(request, status == kOk), request.before + request.after);
  }
}

Route AccessDesk::shown(const char* path, Role role, const char* description,
                        Response (AccessDesk::*handler)(const web::Request&) const) {
  const auto serve = [this, handler](const ExchangePtr& exchange) {
    exchange->answer((this->*handler)(exchange->request()));
  };
  return {"GET", path, role, description, std::string(kJson), serve};
}

std::vector<Route> AccessDesk::routes() {
  const BodyMember user{"user", "Name of a user"}, name{"name", "Name of a program"};
  const BodyMember password{"password", "At least 12 characters"};
  const BodyMember role{"role", "viewer, operator, integrator or administrator"};
  const auto optional = [](BodyMember member) {
    member.is_required = false;
    return member;
  };
  std::vector<Route> routes;
  routes.push_back(shown("/api/v1/session", Role::Nobody,
                         "Returns the caller's identity and whether there are users",
                         &AccessDesk::session));
  routes.push_back(changing("/api/v1/login", Role::Nobody, "Starts a session, kept in a cookie",
                            {user, password}, &AccessDesk::login, &AccessDesk::refuse_login));
  routes.push_back(changing(
      "/api/v1/set_first_password", Role::Nobody,
      "Creates the first administrator, admin, while there are no users, and starts a session",
      {{"code", "Code that the log and `orbwatch password --show` print"}, password},
      &AccessDesk::set_first_password, &AccessDesk::refuse_first_password));
  routes.push_back(
      changing("/api/v1/logout", Role::Viewer, "Ends the session", {}, &AccessDesk::logout));
  routes.push_back(
      changing("/api/v1/set_password", Role::Viewer,
               "Changes the password of the logged-in user; the user's other sessions end",
               {{"old", "The present password"}, {"new", "At least 12 characters"}},
               &AccessDesk::set_password));
  routes.push_back({"GET", "/api/v1/audit", Role::Administrator,
                    "Returns the newest entries of the audit, newest last", std::string(kJson),
                    [this](const ExchangePtr& exchange) { show_audit(exchange); }});
  routes.push_back(shown("/api/v1/users", Role::Administrator,
                         "Returns users and programs, with roles", &AccessDesk::users));
  routes.push_back(
      changing("/api/v1/set_user", Role::Administrator,
               "Adds a user or changes role or password; the first user must be administrator",
               {user, optional(role), optional(password)}, &AccessDesk::set_user));
  routes.push_back(changing("/api/v1/remove_user", Role::Administrator, "Removes a user", {user},
                            &AccessDesk::remove_user));
  routes.push_back(changing("/api/v1/create_token", Role::Administrator,
                            "Creates a token for a program; the token is returned only once",
                            {name, role}, &AccessDesk::create_token));
  routes.push_back(changing("/api/v1/revoke_token", Role::Administrator,
                            "Revokes the token of a program", {name}, &AccessDesk::revoke_token));
  return routes;
}

void AccessDesk::show_audit(const ExchangePtr& exchange) {
  constexpr std::size_t kMostShown = 500;
  work_.run(exchange, asker(exchange->request(), {}), [this] {
    audit_.write_all();
    return json_response(audit_.newest(kMostShown));
  });
}

/// Text such as "kim: viewer"; empty: unknown user.
std::string AccessDesk::role_of(const std::string& user) const {
  const Users all = access_.users();
  const User* found = all.find(user);
  return found ? user + ": " + std::string(word_for(kRoles, found->role)) : "";
}

Response AccessDesk::session(const web::Request& request) const {
  const Caller caller = access_.caller(credentials_of(request));
  Json roles = Json::array();
  for (const auto& role : kRoles) {
    if (role.value <= caller.role) roles.push_back(std::string(role.name));
  }
  return json_response(Json{{"user", caller.name},
                            {"role", std::string(word_for(kRoles, caller.role))},
                            {"roles", roles},
                            {"password_characters", kLeastPasswordCharacters},
                            {"has_users", access_.has_users()}}
                           .dump());
}

Response AccessDesk::users(const web::Request& /*request*/) const {
  const Users all = access_.users();
  return json_response(Json{{"users", list_of(all.users)}, {"tokens", list_of(all.tokens)}}.dump());
}

Response AccessDesk::logged_in(const web::Request& request, const Access::Token& token) const {
  if (!token) return refused(token.error());
  Response response = done();
  response.headers.emplace_back("Set-Cookie", cookie(request, *token, longest_));
  return response;
}

// Only a known name is recorded, because a password may have been typed as the name.
std::optional<Access::Refusal> AccessDesk::refuse_login(Request& request) const {
  const std::string& user = request.members.at("user");
  request.after = role_of(user);
  return access_.login_refusal(user, client_address(request.sent));
}

std::optional<Access::Refusal> AccessDesk::refuse_first_password(Request& request) const {
  return access_.first_password_refusal(client_address(request.sent));
}

Response AccessDesk::login(Request& request) {
  const std::string& user = request.members.at("user");
  const auto token =
      access_.login(user, request.members.at("password"), client_address(request.sent));
  if (token) request.user = user;
  request.after = role_of(user);
  return logged_in(request.sent, token);
}

Response AccessDesk::logout(Request& request) {
  const std::string* session = request.sent.cookie(session_cookie(request.sent));
  request.changes_nothing = !session || !access_.logout(*session);
  Response response = done();
  response.headers.emplace_back("Set-Cookie", cookie(request.sent, "", std::chrono::seconds(0)));
  return response;
}

Response AccessDesk::set_password(Request& request) {
  return logged_in(request.sent, access_.change_password(request.user, request.members.at("old"),
                                                         request.members.at("new"),
                                                         client_address(request.sent)));
}

Response AccessDesk::set_first_password(Request& request) {
  const auto token = access_.set_first_password(
      request.members.at("code"), request.members.at("password"), client_address(request.sent));
  if (token) {
    request.user = kFirstUser;
    request.after = role_of(request.user);
  }
  return logged_in(request.sent, token);
}

/// Changes the users. Trust in this computer ends with the first password, which may be set
/// meanwhile.
Result<> AccessDesk::change(const Request& request, const std::function<Result<>(Users&)>& change) {
  return access_.change([&](Users& all) -> Result<> {
    if (request.user.empty() && !all.users.empty()) {
      return fail("a password has been set meanwhile; log in");
    }
    return change(all);
  });
}

Response AccessDesk::set_user(Request& request) {
  const std::string &user = request.members.at("user"), &password = request.members.at("password");
  std::optional<Role> role;
  if (const std::string& named = request.members.at("role"); !named.empty()) {
    const auto parsed = parse_role(named);
    if (!parsed) return error_response(400, parsed.error().message);
    role = *parsed;
  }
  std::string hash;
  if (!password.empty()) {
    if (auto right = check_password(password); !right) {
      return error_response(400, right.error().message);
    }
    auto hashed = hash_password(password);
    if (!hashed) return error_response(503, hashed.error().message);
    hash = std::move(*hashed);
  }
  request.before = role_of(user);
  const auto changed =
      change(request, [&](Users& all) { return web::set_user(all, user, role, hash); });
  if (changed) request.after = role_of(user) + (hash.empty() ? "" : ", another password");
  return done_or(changed);
}

Response AccessDesk::remove_user(Request& request) {
  const std::string& user = request.members.at("user");
  request.before = role_of(user);
  return done_or(change(request, [&](Users& all) { return remove(all.users, user, "user"); }));
}

Response AccessDesk::create_token(Request& request) {
  const std::string& name = request.members.at("name");
  const auto role = parse_role(request.members.at("role"));
  if (!role) return error_response(400, role.error().message);
  if (auto named = check_name(name); !named) return error_response(400, named.error().message);
  const std::string token = random_token();
  const auto added = change(request, [&](Users& all) -> Result<> {
    if (std::ranges::find(all.tokens, name, &ApiToken::name) != all.tokens.end()) {
      return fail("there is a token " + name + " already; revoke it first");
    }
    all.tokens.push_back({name, *role, token_hash(token)});
    return {};
  });
  if (added) request.after = name + ": " + request.members.at("role");
  return added ? json_response(Json{{"token", token}}.dump()) : done_or(added);
}

Response AccessDesk::revoke_token(Request& request) {
  const std::string& name = request.members.at("name");
  const auto removed =
      change(request, [&](Users& all) { return remove(all.tokens, name, "token"); });
  if (removed) request.before = name;
  return done_or(removed);
}

}  // namespace orbwatch::app::web
