// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "app/model/command/role.h"
#include "app/ports/web/access/access.h"
#include "app/ports/web/access/audit/audit.h"
#include "app/ports/web/access/caller.h"
#include "app/ports/web/access/slow_work.h"
#include "app/ports/web/http/exchange.h"

namespace orbwatch::app::web {

/// A request for a change. The handler states what the audit records.
struct ChangeRequest {
  const Request& request;
  Caller caller{};  ///< set before the handler runs
  /// Name that an unknown client states, for its place in the queue; empty: none.
  std::string claimed_name{};
  std::string before{}, after{};  ///< values for the audit, which has the first 4 KiB of each
  Values headers{};               ///< of the response, in addition to its usual ones
  bool changes_nothing = false;   ///< not recorded in the audit
};

/// A request for a change with its body.
template <class Body>
struct Change : ChangeRequest {
  Change(const Request& request, Body body) : ChangeRequest{request}, body(std::move(body)) {
    if constexpr (requires { this->body.user; }) claimed_name = this->body.user;
  }
  Body body;
};

/// Answer to a change that returns no values.
struct Done {
  std::string result_text = "done";
};
template <class Visitor>
void visit(Visitor& v, Done& done) {
  v.required("result_text", done.result_text, "done");
}

/// Answer to a refused caller. Reentrant.
Response refused(const Access::Refusal& refusal);

/// Carries out changes one after the other on a separate thread, because they wait for the disk or
/// for a hash of a password, and records each in the audit. Thread rule: start and stop by one
/// owner; everything else on any thread.
class Changes {
 public:
  /// `access` and `audit` outlive it. The others as for SlowWork.
  Changes(Access& access, Audit& audit, const char* thread, const char* busy,
          std::size_t most_of_known = SlowWork::kMostOfKnown)
      : access_(access), audit_(audit), work_(thread, busy, most_of_known) {}

  void start() { work_.start(); }
  void stop() { work_.stop(); }
  std::chrono::nanoseconds cpu_time() const { return work_.cpu_time(); }

  /// Answers a request by `handle`, and records it; does not wait. The role is checked again,
  /// because the request may have waited.
  void run(const ExchangePtr& exchange, const std::shared_ptr<ChangeRequest>& change, Role role,
           std::function<Response()> handle);
  /// Answers a request that only reads by `handle`, without a record; does not wait.
  void read(const ExchangePtr& exchange, std::function<Response()> handle);
  /// Refusal for a client without a role, counted in the audit. A 503 is a fault of the appliance
  /// and does not count as an attempt.
  Response refuse_unknown(const ChangeRequest& change, const Access::Refusal& refusal);

 private:
  SlowWork::Asker asker(const Request& sent, const std::string& claimed_name) const;
  void note(const ChangeRequest& change, Role role, int status);

  Access& access_;
  Audit& audit_;
  SlowWork work_;
};

}  // namespace orbwatch::app::web
