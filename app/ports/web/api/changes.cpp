// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/api/changes.h"

#include <algorithm>
#include <iterator>

#include "app/ports/web/http/address.h"

namespace orbwatch::app::web {
namespace {

/// Bytes of the values by which the audit tells changes apart.
constexpr std::size_t kMostCompared = 256;
/// Bytes of a value in an entry, so that no client fills the audit's files with a few entries.
constexpr std::size_t kMostOfValue = 4096;
constexpr int kOk = 200, kTooManyRequests = 429, kUnavailable = 503;

/// The value, cut between characters of UTF-8.
std::string cut_value(const std::string& value) {
  if (value.size() <= kMostOfValue) return value;
  std::size_t end = kMostOfValue;
  while (end > 0 && (static_cast<unsigned char>(value[end]) & 0xC0U) == 0x80U) --end;
  return value.substr(0, end);
}

/// The last part of the path is the action.
Audit::Entry entry_of(const ChangeRequest& change, bool is_done) {
  const std::string& path = change.request.path;
  return {std::chrono::system_clock::now(), change.caller.name,
          client_address(change.request),   path.substr(path.rfind('/') + 1),
          cut_value(change.before),         cut_value(change.after),
          is_done ? "done" : "refused"};
}

}  // namespace

Response refused(const Access::Refusal& refusal) {
  Response response = error_response(refusal.status, refusal.what);
  if (refusal.retry_after.count() > 0) {
    response.headers.emplace_back("Retry-After", std::to_string(refusal.retry_after.count()));
  }
  return response;
}

void Changes::run(const ExchangePtr& exchange, const std::shared_ptr<ChangeRequest>& change,
                  Role role, std::function<Response()> handle) {
  const auto work = [this, change, role, handle = std::move(handle)]() -> Response {
    access_.refresh();
    change->caller = access_.caller(credentials_of(change->request));
    if (change->caller.role < role) {
      return error_response(401, "the required role has expired; log in again");
    }
    Response response = handle();
    std::ranges::move(change->headers, std::back_inserter(response.headers));
    note(*change, role, response.status);
    return response;
  };
  work_.run(exchange, asker(change->request, change->claimed_name), work);
}

void Changes::read(const ExchangePtr& exchange, std::function<Response()> handle) {
  work_.run(exchange, asker(exchange->request(), ""), std::move(handle));
}

/// Client in the queues. A user does not wait behind guesses of others at an address from which the
/// user has logged in before.
SlowWork::Asker Changes::asker(const Request& sent, const std::string& claimed_name) const {
  const Caller caller = access_.caller(credentials_of(sent));
  if (caller.role != Role::Nobody) return {true, caller.name};
  const std::string peer = client_address(sent);
  return {!claimed_name.empty() && access_.is_familiar(claimed_name, peer), address_key(peer)};
}

Response Changes::refuse_unknown(const ChangeRequest& change, const Access::Refusal& refusal) {
  constexpr std::uint64_t kMostRefused = 20;
  if (refusal.status == kUnavailable) return refused(refusal);
  const auto count = audit_.note_refused(entry_of(change, false));
  if (count <= kMostRefused || refusal.status == kTooManyRequests) return refused(refusal);
  const std::chrono::seconds wait = Repetitions::kPeriod;
  return refused({kTooManyRequests,
                  "too many refused requests from this address; try again in " +
                      std::to_string(wait.count()) + " s",
                  wait});
}

/// Requests refused for their rate are counted if they come without a role, and otherwise not
/// recorded, because they would displace all other entries. A user's refusals of one action are of
/// one kind, whatever their values, because the client chooses these.
void Changes::note(const ChangeRequest& change, Role role, int status) {
  if (status == kUnavailable || change.changes_nothing) return;
  if (role == Role::Nobody && status != kOk) {
    audit_.note_refused(entry_of(change, false));
  } else if (status != kTooManyRequests) {
    const bool is_done = status == kOk;
    audit_.note(entry_of(change, is_done),
                is_done ? (change.before + change.after).substr(0, kMostCompared) : "");
  }
}

}  // namespace orbwatch::app::web
