// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/audit/repetitions.h"

#include <iterator>
#include <utility>

namespace orbwatch::app::web {
namespace {

/// Returns whether a period has ended, or began in the future after the clock was set back.
bool is_over(Repetitions::Time begun, std::chrono::minutes period, Repetitions::Time now) {
  return now - begun >= period || begun - now >= period;
}

}  // namespace

/// Finds or adds a kind; the empty name represents all kinds beyond the limit.
Repetitions::Kinds::iterator Repetitions::find(const std::string& name, Time now) {
  const auto found = kinds_.find(name);
  if (found != kinds_.end()) return found;
  return kinds_.try_emplace(kinds_.size() < most_kinds_ ? name : "", Kind{now, now}).first;
}

Repetitions::Counted Repetitions::count(const std::string& name, AuditEntry entry) {
  const auto found = find(name, entry.time);
  Kind& kind = found->second;
  if (is_over(kind.begun, kPeriod, entry.time)) {
    kind.begun = entry.time;
    kind.count = 0;
  }
  ++kind.count;
  // A waiting count is recorded before newer entries of its kind.
  if (kind.count <= free_ && kind.more == 0) return {true, kind.count};
  if (found->first.empty()) entry.from = "(others)";
  if (++kind.more > 1) entry.before = std::move(kind.newest.before);
  kind.newest = std::move(entry);
  return {false, kind.count};
}

AuditEntry Repetitions::take(Kind& kind) {
  AuditEntry entry = std::move(kind.newest);
  entry.result += ", " + std::to_string(kind.more) + " more";
  kind.more = 0;
  kind.newest = {};
  return entry;
}

std::vector<AuditEntry> Repetitions::take_due(Time now) {
  std::vector<AuditEntry> due;
  for (auto one = kinds_.begin(); one != kinds_.end();) {
    Kind& kind = one->second;
    if (is_over(kind.reported, kReportPeriod, now)) {
      if (kind.more > 0) due.push_back(take(kind));
      kind.reported = now;
    }
    const bool is_forgotten = kind.more == 0 && is_over(kind.begun, kPeriod, now);
    one = is_forgotten ? kinds_.erase(one) : std::next(one);
  }
  return due;
}

std::vector<AuditEntry> Repetitions::take_all() {
  std::vector<AuditEntry> all;
  for (auto& [name, kind] : kinds_) {
    if (kind.more > 0) all.push_back(take(kind));
  }
  return all;
}

}  // namespace orbwatch::app::web
