// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/ports/web/access/access.h"
#include "app/ports/web/access/access_body.h"
#include "app/ports/web/access/audit.h"
#include "app/ports/web/access/slow_work.h"
#include "app/ports/web/routes.h"

namespace orbwatch::app::web {

/// Answer to a refused caller. Reentrant.
Response refused(const Access::Refusal& refusal);

/// Routes by which users and programs log in, and by which the administrator manages them. Thread
/// rule: start and stop by one owner; the routes on any thread.
class AccessDesk {
 public:
  /// `access` and `audit` outlive the desk. `longest` is the limit of a session's age.
  AccessDesk(Access& access, Audit& audit, std::chrono::seconds longest)
      : access_(access), audit_(audit), longest_(longest) {}

  void start() { work_.start(); }
  void stop() { work_.stop(); }

  std::vector<Route> routes();

  std::chrono::nanoseconds cpu_time() const { return work_.cpu_time(); }

 private:
  struct Request {
    const web::Request& sent;
    const Members& members;
    std::string user;               ///< name of the caller
    std::string before{}, after{};  ///< values for the audit
    bool changes_nothing = false;   ///< not recorded in the audit
  };
  using Handler = Response (AccessDesk::*)(Request&);
  /// Refusal of a client without a role, regardless of the secret that it sends; nullopt: none.
  using Refuse = std::optional<Access::Refusal> (AccessDesk::*)(Request&) const;

  /// Handling of a request, at once and on the desk's thread.
  struct Task {
    Role role = Role::Administrator;
    Handler handler = nullptr;
    Refuse refuse = nullptr;
  };

  /// `refuse` null: no request is refused at once.
  Route changing(const char* path, Role role, const char* description, std::vector<BodyMember> body,
                 Handler handler, Refuse refuse = nullptr);
  void receive(const ExchangePtr& exchange, Members members, const Task& task);
  Response refuse_unknown(Request& request, const Access::Refusal& refusal);
  SlowWork::Asker asker(const web::Request& sent, const Members& members) const;
  Result<> change(const Request& request, const std::function<Result<>(Users&)>& change);
  Route shown(const char* path, Role role, const char* description,
              Response (AccessDesk::*handler)(const web::Request&) const);

  Response session(const web::Request& request) const;
  Response users(const web::Request& request) const;
  Response login(Request& request);
  Response logout(Request& request);
  Response set_password(Request& request);
  Response set_first_password(Request& request);
  Response set_user(Request& request);
  Response remove_user(Request& request);
  Response create_token(Request& request);
  Response revoke_token(Request& request);
  std::optional<Access::Refusal> refuse_login(Request& request) const;
  std::optional<Access::Refusal> refuse_first_password(Request& request) const;
  Response answer_and_note(const ExchangePtr& exchange, const Members& members, const Task& task);
  void note(const Request& request, const Task& task, int status);
  static Audit::Entry entry_of(const Request& request, bool is_done);
  void show_audit(const ExchangePtr& exchange);
  std::string role_of(const std::string& user) const;
  Response logged_in(const web::Request& request, const Access::Token& token) const;

  Access& access_;
  Audit& audit_;
  const std::chrono::seconds longest_;
  SlowWork work_{"web access", "too many logins or changes of users at present; try again"};
};

}  // namespace orbwatch::app::web
