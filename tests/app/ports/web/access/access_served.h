// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "app/ports/web/access/login/secret.h"
#include "app/ports/web/access/users.h"
#include "tests/app/ports/web/served.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {

inline const std::string kPassword = "correct horse battery";
/// Address of a client that is not the board itself.
inline const std::string kPeer = "10.0.0.9";
/// Headers that the page's own scripts send with a change.
inline const std::string kPageHeaders = kJsonHeader + "X-Orbwatch: page\r\n";

/// A sink with a state folder, and on request with a user and a token of each role.
class AccessServed : public Served {
 protected:
  void SetUp() override { state_folder = folder.path(); }
  /// Destroys the sink first, which writes to the folder until its end.
  ~AccessServed() override { sink.reset(); }

  /// Adds a user and a token for each role, named like the role.
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

  /// Headers of a program with a role; empty for Nobody.
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
  /// Cookie header for the session that an answer starts.
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
