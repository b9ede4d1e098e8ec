#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "app/ports/web/access/secret.h"
#include "app/ports/web/access/users.h"
#include "tests/app/ports/web/served.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {

inline const std::string kPassword = "correct horse battery";
/// Who is not at the board itself.
inline const std::string kPeer = "10.0.0.9";
/// What the page's own scripts send with a change.
inline const std::string kPageHeaders = kJsonHeader + "X-Orbwatch: page\r\n";

/// A sink that serves with a state folder, and with a user and a token of each role once asked for.
class AccessServed : public Served {
 protected:
  void SetUp() override { state_folder = folder.path(); }
  /// The sink writes to the folder until it ends.
  ~AccessServed() override { sink.reset(); }

  /// The user and the token of a role have its name.
  void add_one_of_each_role() {
    const std::string hash = hash_password(kPassword).value();
    ASSERT_TRUE(change_users(users_file(state_folder), [&](Users& users) {
      for (const auto& [name, role] : kRoles) {
        users.users.push_back({std::string(name), role, hash});
        const std::string token = random_token();
        users.tokens.push_back({std::string(name), role, token_hash(token)});
        tokens[role] = token;
      }
      return Result<>();
    }));
  }

  /// The headers of a program with a role; none of Nobody.
  std::string by_token(Role role) const {
    return role == Role::Nobody ? "" : "Authorization: Bearer " + tokens.at(role) + "\r\n";
  }
  Answer post(const std::string& path, const std::string& body, const std::string& headers) const {
    return request(port(), "POST", path, headers, body);
  }
  Answer login(const std::string& user, const std::string& password) const {
    return post("/api/v1/login", nlohmann::json{{"user", user}, {"password", password}}.dump(),
                kPageHeaders);
  }
  /// The header of a session that an answer begins.
  static std::string cookie_of(const Answer& answer) {
    const auto found = answer.headers.find("Set-Cookie");
    if (found == answer.headers.end()) return "";
    return "Cookie: " + found->second.substr(0, found->second.find(';')) + "\r\n";
  }
  std::string session_of(const std::string& user) const {
    const Answer answer = login(user, kPassword);
    EXPECT_EQ(answer.status, 200) << answer.body;
    return cookie_of(answer);
  }

  orbwatch::tests::TemporaryFolder folder;
  std::map<Role, std::string> tokens;
};

}  // namespace orbwatch::app::web::tests
