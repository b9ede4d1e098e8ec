// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "app/ports/web/access/access.h"
#include "app/ports/web/access/access_records.h"
#include "app/ports/web/access/audit/audit.h"
#include "app/ports/web/api/changes.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/api/route.h"

namespace orbwatch::app::web {

/// Handlers by which users and programs log in, and by which the administrator manages them.
/// Thread-safe; those with a Change wait for the disk or for a hash.
class AccessDesk {
 public:
  /// `access`, `audit` and `changes` outlive the desk. `longest` is the limit of a session's age.
  AccessDesk(Access& access, Audit& audit, Changes& changes, std::chrono::seconds longest)
      : access_(access), audit_(audit), changes_(changes), longest_(longest) {}

  Answered<SessionAnswer> session(const Request& request) const;
  Answered<Users> users() const;
  void audit(const ExchangePtr& exchange);

  Answered<Done> login(Change<LoginBody>& change);
  Answered<Done> logout(Change<Nothing>& change);
  Answered<Done> set_password(Change<PasswordBody>& change);
  Answered<Done> set_first_password(Change<FirstPasswordBody>& change);
  Answered<Done> set_user(Change<UserBody>& change);
  Answered<Done> remove_user(Change<UserNameBody>& change);
  Answered<TokenAnswer> create_token(Change<TokenBody>& change);
  Answered<Done> revoke_token(Change<TokenNameBody>& change);

  /// @name Refusals regardless of the secret that is sent; nullopt: it is checked. They do not
  /// wait.
  /// @{
  std::optional<Access::Refusal> refuse_login(Change<LoginBody>& change) const;
  std::optional<Access::Refusal> refuse_first_password(Change<FirstPasswordBody>& change) const;
  /// @}

 private:
  Answered<Done> change_users(const ChangeRequest& change,
                              const std::function<Result<>(Users&)>& edit);
  Answered<Done> logged_in(ChangeRequest& change, const Access::Token& token) const;
  std::string role_of(const std::string& user) const;

  Access& access_;
  Audit& audit_;
  Changes& changes_;
  const std::chrono::seconds longest_;
};

}  // namespace orbwatch::app::web
