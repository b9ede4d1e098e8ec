#include "app/ports/web/access/access_desk.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/ports/web/access/secret.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

Response done() { return json_response(R"({"result_text":"done"})"); }

Response refused(const Access::Refusal& refusal) {
  Response response = error_response(refusal.status, refusal.what);
  if (refusal.retry_after.count() > 0) {
    response.headers.emplace_back("Retry-After", std::to_string(refusal.retry_after.count()));
  }
  return response;
}

Response done_or(const Result<>& result) {
  return result ? done() : error_response(409, result.error().message);
}

std::string cookie(const web::Request& request, const std::string& token,
                   std::chrono::seconds age) {
  return std::string(session_cookie(request)) + "=" + token +
         "; Path=/; HttpOnly; SameSite=Strict; Max-Age=" + std::to_string(age.count()) +
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

/// Error: there was none of that name.
template <class One>
Result<> remove(std::vector<One>& all, const std::string& name, const char* what) {
  if (std::erase_if(all, [&](const One& one) { return one.name == name; }) > 0) return {};
  return fail(std::string("there is no ") + what + " " + name);
}

}  // namespace

Route AccessDesk::changing(const char* path, Role role, const char* description,
                           std::vector<BodyMember> body, Handler handler) {
  Route route{"POST", path, role, description, std::string(kJson), {}};
  route.body = body;
  route.serve = [this, handler, body = std::move(body)](const ExchangePtr& exchange) {
    auto members = parse_members(body, exchange->request().body);
    if (!members) {
      exchange->answer(error_response(400, members.error().message));
      return;
    }
    work_.run(exchange, [this, handler, exchange, members = std::move(*members)] {
      return answer_and_note(exchange, members, handler);
    });
  };
  return route;
}

/// What was refused because of too many is not noted: it would push everything else out.
Response AccessDesk::answer_and_note(const ExchangePtr& exchange, const Members& members,
                                     Handler handler) {
  const web::Request& sent = exchange->request();
  Request request{sent, members, access_.caller(credentials_of(sent)).name};
  Response response = (this->*handler)(request);
  constexpr int kDone = 200, kTooMany = 429, kBusy = 503;
  if (response.status != kTooMany && response.status != kBusy) {
    const std::string name = sent.path.substr(sent.path.rfind('/') + 1);
    audit_.note({Access::utc_now(), request.user, sent.peer, name, request.before, request.after,
                 response.status == kDone ? "done" : "refused"});
  }
  return response;
}

Route AccessDesk::shown(const char* path, Role role, const char* description,
                        Response (AccessDesk::*handler)(const web::Request&) const) {
  const auto serve = [this, handler](const ExchangePtr& exchange) {
    exchange->answer((this->*handler)(exchange->request()));
  };
  return {"GET", path, role, description, std::string(kJson), serve};
}

std::vector<Route> AccessDesk::routes() {
  const BodyMember user{"user", "Name of a person"}, name{"name", "Name of a program"};
  const BodyMember password{"password", "At least 12 characters"};
  const BodyMember role{"role", "viewer, operator, integrator or administrator"};
  const auto optional = [](BodyMember member) {
    member.is_required = false;
    return member;
  };
  std::vector<Route> routes;
  routes.push_back(shown("/api/v1/session", Role::Nobody, "Who asks, and whether there are users",
                         &AccessDesk::session));
  routes.push_back(changing("/api/v1/login", Role::Nobody, "Begins a session, kept in a cookie",
                            {user, password}, &AccessDesk::login));
  routes.push_back(
      changing("/api/v1/set_first_password", Role::Nobody,
               "Makes the first administrator, admin, while there are no users, and "
               "begins a session",
               {{"code", "As the log and `orbwatch password --show` have it"}, password},
               &AccessDesk::set_first_password));
  routes.push_back(
      changing("/api/v1/logout", Role::Viewer, "Ends the session", {}, &AccessDesk::logout));
  routes.push_back(changing("/api/v1/set_password", Role::Viewer,
                            "Changes the password of whoever is logged in; other sessions end",
                            {{"old", "The present one"}, {"new", "At least 12 characters"}},
                            &AccessDesk::set_password));
  routes.push_back({"GET", "/api/v1/audit", Role::Administrator,
                    "Who did what: the newest entries, newest last", std::string(kJson),
                    [this](const ExchangePtr& exchange) { show_audit(exchange); }});
  routes.push_back(shown("/api/v1/users", Role::Administrator, "People and programs, with roles",
                         &AccessDesk::users));
  routes.push_back(changing("/api/v1/set_user", Role::Administrator,
                            "Adds a person or changes role or password; the first one must be "
                            "administrator",
                            {user, optional(role), optional(password)}, &AccessDesk::set_user));
  routes.push_back(changing("/api/v1/remove_user", Role::Administrator, "Removes a person", {user},
                            &AccessDesk::remove_user));
  routes.push_back(changing("/api/v1/create_token", Role::Administrator,
                            "Lets a program in. The token is told this once", {name, role},
                            &AccessDesk::create_token));
  routes.push_back(changing("/api/v1/revoke_token", Role::Administrator,
                            "Keeps a program out again", {name}, &AccessDesk::revoke_token));
  return routes;
}

void AccessDesk::show_audit(const ExchangePtr& exchange) {
  constexpr std::size_t kMostShown = 500;
  work_.run(exchange, [this] { return json_response(audit_.newest(kMostShown)); });
}

/// "kim: viewer"; empty: there is no such user.
std::string AccessDesk::role_of(const std::string& user) const {
  const Users all = access_.users();
  const User* found = all.find(user);
  return found ? user + ": " + std::string(word_for(kRoles, found->role)) : "";
}

Response AccessDesk::session(const web::Request& request) const {
  const Caller caller = access_.caller(credentials_of(request));
  return json_response(Json{{"user", caller.name},
                            {"role", std::string(word_for(kRoles, caller.role))},
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

Response AccessDesk::login(Request& request) {
  const std::string& user = request.members.at("user");
  const auto token = access_.login(user, request.members.at("password"), request.sent.peer);
  if (token) request.user = user;
  // Only a known name: a password may have been typed in its place.
  request.after = role_of(user);
  return logged_in(request.sent, token);
}

Response AccessDesk::logout(Request& request) {
  const std::string* session = request.sent.cookie(session_cookie(request.sent));
  if (session) access_.logout(*session);
  Response response = done();
  response.headers.emplace_back("Set-Cookie", cookie(request.sent, "", std::chrono::seconds(0)));
  return response;
}

Response AccessDesk::set_password(Request& request) {
  return logged_in(request.sent,
                   access_.change_password(request.user, request.members.at("old"),
                                           request.members.at("new"), request.sent.peer));
}

Response AccessDesk::set_first_password(Request& request) {
  const auto token = access_.set_first_password(request.members.at("code"),
                                                request.members.at("password"), request.sent.peer);
  if (token) {
    request.user = kFirstUser;
    request.after = role_of(request.user);
  }
  return logged_in(request.sent, token);
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
      access_.change([&](Users& all) { return web::set_user(all, user, role, hash); });
  if (changed) request.after = role_of(user) + (hash.empty() ? "" : ", another password");
  return done_or(changed);
}

Response AccessDesk::remove_user(Request& request) {
  const std::string& user = request.members.at("user");
  request.before = role_of(user);
  return done_or(access_.change([&](Users& all) { return remove(all.users, user, "user"); }));
}

Response AccessDesk::create_token(Request& request) {
  const std::string& name = request.members.at("name");
  const auto role = parse_role(request.members.at("role"));
  if (!role) return error_response(400, role.error().message);
  if (auto named = check_name(name); !named) return error_response(400, named.error().message);
  const std::string token = random_token();
  const auto added = access_.change([&](Users& all) -> Result<> {
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
      access_.change([&](Users& all) { return remove(all.tokens, name, "token"); });
  if (removed) request.before = name;
  return done_or(removed);
}

}  // namespace orbwatch::app::web
