// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/audit/audit.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "app/ports/web/http/address.h"

namespace orbwatch::app::web {
namespace {

using AuditEntries = std::vector<Json>;

std::string kind_of(std::initializer_list<std::string> parts) {
  std::string kind;
  for (const std::string& part : parts) kind += part + '\n';
  return kind;
}

bool is_earlier(const Json& a, const Json& b) { return a.value("time", "") < b.value("time", ""); }

/// Merges by time, keeping the order of each list even if the clock was set back in between.
AuditEntries merge(AuditEntries a, AuditEntries b) {
  AuditEntries merged;
  merged.reserve(a.size() + b.size());
  auto next_a = a.begin(), next_b = b.begin();
  while (next_a != a.end() && next_b != b.end()) {
    auto& next = is_earlier(*next_b, *next_a) ? next_b : next_a;
    merged.push_back(std::move(*next++));
  }
  std::move(next_a, a.end(), std::back_inserter(merged));
  std::move(next_b, b.end(), std::back_inserter(merged));
  return merged;
}

/// The newest entries, with a guaranteed share for each user; in their order.
AuditEntries fair(AuditEntries all, std::size_t most) {
  constexpr std::size_t kUsers = 10;
  if (all.size() <= most) return all;
  std::vector<bool> is_shown(all.size());
  std::map<std::string, std::size_t> shown_of;
  std::size_t shown = 0;
  for (const std::size_t share : {std::max<std::size_t>(1, most / kUsers), most}) {
    for (std::size_t i = all.size(); i-- > 0 && shown < most;) {
      if (is_shown[i] || shown_of[all[i].value("who", "")] >= share) continue;
      is_shown[i] = true;
      ++shown_of[all[i].value("who", "")];
      ++shown;
    }
  }
  AuditEntries chosen;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_shown[i]) chosen.push_back(std::move(all[i]));
  }
  return chosen;
}

}  // namespace

Audit::Audit(const std::filesystem::path& state_folder)
    : file_(state_folder, "audit"), refused_file_(state_folder, "audit-refused") {}

void Audit::note(const Entry& entry, const std::string& subject) {
  {
    const std::lock_guard lock(mutex_);
    const std::string kind = kind_of({entry.who, entry.what, entry.result, subject});
    if (!repetitions_.count(kind, entry).is_noted) return;
  }
  file_.append({entry});
}

std::uint64_t Audit::note_refused(const Entry& entry) {
  const std::string kind = kind_of({address_key(entry.from), entry.what, entry.after});
  const std::lock_guard lock(mutex_);
  const auto counted = refused_.count(kind, entry);
  if (counted.is_noted) waiting_.push_back(entry);
  return counted.count;
}

void Audit::write_due(Repetitions::Time now) {
  std::vector<Entry> counts, refused_counts;
  {
    const std::lock_guard lock(mutex_);
    counts = repetitions_.take_due(now);
    refused_counts = refused_.take_due(now);
  }
  write_waiting(std::move(counts), std::move(refused_counts));
}

void Audit::write_all() {
  std::vector<Entry> counts, refused_counts;
  {
    const std::lock_guard lock(mutex_);
    counts = repetitions_.take_all();
    refused_counts = refused_.take_all();
  }
  write_waiting(std::move(counts), std::move(refused_counts));
}

void Audit::write_waiting(std::vector<Entry> counts, std::vector<Entry> refused_counts) {
  std::vector<Entry> refused;
  {
    const std::lock_guard lock(mutex_);
    refused = std::exchange(waiting_, {});
  }
  std::ranges::move(refused_counts, std::back_inserter(refused));
  // The entries are in the order of their kinds.
  std::ranges::stable_sort(refused, {}, &Entry::time);
  std::ranges::stable_sort(counts, {}, &Entry::time);
  file_.append(counts);
  refused_file_.append(refused);
}

std::vector<Json> Audit::newest(std::size_t most) const {
  AuditEntries refused = refused_file_.newest(std::min(most, kMostRefusedShown));
  AuditEntries entries =
      fair(file_.newest(std::numeric_limits<std::size_t>::max()), most - refused.size());
  return merge(std::move(entries), std::move(refused));
}

}  // namespace orbwatch::app::web
