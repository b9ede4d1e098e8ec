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

/// The newest entries, with a guaranteed share for each value of `member`; in their order.
AuditEntries fair(AuditEntries all, std::size_t most, const std::string& member) {
  constexpr std::size_t kShares = 10;
  if (all.size() <= most) return all;
  std::vector<bool> is_shown(all.size());
  std::map<std::string, std::size_t> shown_of;
  std::size_t shown = 0;
  for (const std::size_t share : {std::max<std::size_t>(1, most / kShares), most}) {
    for (std::size_t i = all.size(); i-- > 0 && shown < most;) {
      if (is_shown[i] || shown_of[all[i].value(member, "")] >= share) continue;
      is_shown[i] = true;
      ++shown_of[all[i].value(member, "")];
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
    : file_(state_folder, "audit"),
      commands_file_(state_folder, "audit-commands"),
      refused_file_(state_folder, "audit-refused") {}

void Audit::note(const Entry& entry, const std::string& subject) {
  {
    const std::lock_guard lock(mutex_);
    const std::string kind = kind_of({entry.who, entry.what, entry.result, subject});
    if (!repetitions_.count(kind, entry).is_noted) return;
  }
  file_.append({entry});
}

void Audit::note_command(const Entry& entry, const std::string& interface) {
  const std::string kind = kind_of({interface, entry.what, entry.result});
  const std::lock_guard lock(mutex_);
  commands_.note(kind, entry);
}

std::uint64_t Audit::note_refused(const Entry& entry) {
  const std::string kind = kind_of({address_key(entry.from), entry.what, entry.after});
  const std::lock_guard lock(mutex_);
  return refused_.note(kind, entry);
}

std::uint64_t Audit::Deferred::note(const std::string& kind, const Entry& entry) {
  const auto counted = repetitions.count(kind, entry);
  if (counted.is_noted) waiting.push_back(entry);
  return counted.count;
}

std::vector<Audit::Entry> Audit::Deferred::take(const TakeCounts& take_counts) {
  std::vector<Entry> taken = std::exchange(waiting, {});
  std::ranges::move(take_counts(repetitions), std::back_inserter(taken));
  // Counts are in the order of their kinds.
  std::ranges::stable_sort(taken, {}, &Entry::time);
  return taken;
}

void Audit::write_due(Repetitions::Time now) {
  write([now](Repetitions& repetitions) { return repetitions.take_due(now); });
}

void Audit::write_all() {
  write([](Repetitions& repetitions) { return repetitions.take_all(); });
}

void Audit::write(const TakeCounts& take_counts) {
  const std::lock_guard writing(writing_);
  std::vector<Entry> counts, commands, refused;
  {
    const std::lock_guard lock(mutex_);
    counts = take_counts(repetitions_);
    commands = commands_.take(take_counts);
    refused = refused_.take(take_counts);
  }
  std::ranges::stable_sort(counts, {}, &Entry::time);
  file_.append(counts);
  commands_file_.append(commands);
  refused_file_.append(refused);
}

std::vector<Json> Audit::newest(std::size_t most) const {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  AuditEntries refused = refused_file_.newest(std::min(most, kMostRefusedShown));
  std::size_t room = most - refused.size();
  AuditEntries commands =
      fair(commands_file_.newest(kAll), std::min(room, kMostCommandsShown), "what");
  room -= commands.size();
  AuditEntries entries = fair(file_.newest(kAll), room, "who");
  return merge(merge(std::move(entries), std::move(commands)), std::move(refused));
}

}  // namespace orbwatch::app::web
