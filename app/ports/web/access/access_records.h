// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/command/role.h"
#include "app/ports/web/access/audit/audit_entry.h"
#include "app/ports/web/access/login/secret.h"
#include "app/ports/web/access/users.h"

/// Bodies and answers of AccessDesk.
namespace orbwatch::app::web {

inline constexpr std::string_view kPasswordForm = "At least 12 characters";
static_assert(kLeastPasswordCharacters == 12);

struct SessionAnswer {
  std::string user;
  std::string_view role;
  std::vector<std::string_view> roles;
  std::size_t password_characters = kLeastPasswordCharacters;
  bool has_users = false;
};
template <class Visitor>
void visit(Visitor& v, SessionAnswer& session) {
  v.required("user", session.user, "Name of the user or program; empty: not logged in");
  v.required("role", session.role, "The caller's role; empty: none");
  v.required("roles", session.roles, "Roles whose rights the caller has, in ascending order");
  v.required("password_characters", session.password_characters, "Shortest length of a password");
  v.required("has_users", session.has_users, "There are users, or their file is unusable");
}

/// @name Users and programs are sent without their secrets.
/// @{
template <class Visitor>
void visit(Visitor& v, User& user) {
  v.required("name", user.name, "Name of the user");
  v.required("role", user.role, kRoles, "Role of the user");
}
template <class Visitor>
void visit(Visitor& v, ApiToken& token) {
  v.required("name", token.name, "Name of the program");
  v.required("role", token.role, kRoles, "Role of the program");
}
template <class Visitor>
void visit(Visitor& v, Users& all) {
  v.required("users", all.users, "Users");
  v.required("tokens", all.tokens, "Programs with a token");
}
/// @}

struct AuditAnswer {
  std::vector<AuditEntry> entries;
};
template <class Visitor>
void visit(Visitor& v, AuditAnswer& audit) {
  v.required("entries", audit.entries, "Entries, newest last");
}

struct LoginBody {
  std::string user, password;
};
template <class Visitor>
void visit(Visitor& v, LoginBody& body) {
  v.required("user", body.user, "Name of a user");
  v.required("password", body.password, "The user's password");
}

struct FirstPasswordBody {
  std::string code, password;
};
template <class Visitor>
void visit(Visitor& v, FirstPasswordBody& body) {
  v.required("code", body.code, "Code that the log and `orbwatch password --show` print");
  v.required("password", body.password, kPasswordForm);
}

struct PasswordBody {
  std::string old_password, new_password;
};
template <class Visitor>
void visit(Visitor& v, PasswordBody& body) {
  v.required("old", body.old_password, "The present password");
  v.required("new", body.new_password, kPasswordForm);
}

struct UserBody {
  std::string user;
  std::optional<Role> role;
  std::string password;
};
template <class Visitor>
void visit(Visitor& v, UserBody& body) {
  v.required("user", body.user, "Name of a user");
  v.optional("role", body.role, kRoles, "Role; default: unchanged");
  v.optional("password", body.password, kPasswordForm);
}

struct UserNameBody {
  std::string user;
};
template <class Visitor>
void visit(Visitor& v, UserNameBody& body) {
  v.required("user", body.user, "Name of a user");
}

struct TokenBody {
  std::string name;
  Role role = Role::Viewer;
};
template <class Visitor>
void visit(Visitor& v, TokenBody& body) {
  v.required("name", body.name, "Name of a program");
  v.required("role", body.role, kRoles, "Role of the program");
}

struct TokenNameBody {
  std::string name;
};
template <class Visitor>
void visit(Visitor& v, TokenNameBody& body) {
  v.required("name", body.name, "Name of a program");
}

struct TokenAnswer {
  std::string token;
};
template <class Visitor>
void visit(Visitor& v, TokenAnswer& answer) {
  v.required("token", answer.token, "The token, for the header Authorization: Bearer");
}

}  // namespace orbwatch::app::web
