// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/login/login_limits.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace orbwatch::app::web {
namespace {

using std::chrono::seconds;
using Entries = std::vector<LoginLimits::Entry>;

/// Returns whether an entry has expired, or is from the future after the clock was set back.
bool is_forgotten(const LoginLimits::Entry& entry, Utc now) {
  return now - entry.last >= LoginLimits::kForgetAfter ||
         entry.last - now >= LoginLimits::kForgetAfter;
}

seconds wait_of(const LoginLimits::Entry& entry, seconds longest, Utc now) {
  const int beyond = entry.failures - LoginLimits::kFree;
  if (beyond < 0 || is_forgotten(entry, now)) return seconds(0);
  constexpr int kMostDoublings = 16;
  const seconds whole = std::min(longest, seconds(1 << std::min(beyond, kMostDoublings)));
  return std::clamp(entry.last + whole - now, seconds(0), whole);
}

seconds wait_of(const Entries& entries, const std::string& key, seconds longest, Utc now) {
  const auto found = std::ranges::find(entries, key, &LoginLimits::Entry::key);
  return found == entries.end() ? seconds(0) : wait_of(*found, longest, now);
}

void count(LoginLimits::Entry& entry, Utc now) {
  constexpr int kMostCounted = 1'000'000;
  entry.failures = is_forgotten(entry, now) ? 1 : std::min(entry.failures + 1, kMostCounted);
  entry.last = now;
}

bool is_for(const LoginLimits::Familiar& familiar, const LoginLimits::Attempt& attempt) {
  return familiar.failed.key == attempt.name && familiar.address == attempt.address;
}

/// Counts a failure. In a flood of new keys these replace each other, not those that already have
/// to wait.
void count(Entries& entries, const std::string& key, Utc now) {
  std::erase_if(entries, [&](const auto& entry) { return is_forgotten(entry, now); });
  const auto found = std::ranges::find(entries, key, &LoginLimits::Entry::key);
  if (found != entries.end()) return count(*found, now);
  if (entries.size() >= LoginLimits::kMostKept) {
    entries.erase(std::ranges::min_element(
        entries, {}, [](const auto& entry) { return std::tuple(entry.failures, entry.last); }));
  }
  entries.push_back({key, 1, now});
}

}  // namespace

const LoginLimits::Familiar* LoginLimits::find_familiar(const Attempt& attempt) const {
  const auto found =
      std::ranges::find_if(familiar_, [&](const Familiar& one) { return is_for(one, attempt); });
  return found == familiar_.end() ? nullptr : &*found;
}

bool LoginLimits::is_familiar(const Attempt& attempt) const {
  return find_familiar(attempt) != nullptr;
}

seconds LoginLimits::wait(const Attempt& attempt, Utc now) const {
  if (const Familiar* familiar = find_familiar(attempt)) {
    return wait_of(familiar->failed, kLongestForName, now);
  }
  if (attempt.is_local) return wait_of(addresses_, attempt.address, kLongestForName, now);
  const seconds for_address = wait_of(addresses_, attempt.address, kLongestForAddress, now);
  // A code has 40 random bits: limits per address suffice, and a common limit would lock out the
  // holder of the code.
  if (attempt.name.empty()) return for_address;
  return std::max(for_address, wait_of(names_, attempt.name, kLongestForName, now));
}

void LoginLimits::failed(const Attempt& attempt, Utc now) {
  for (Familiar& one : familiar_) {
    if (is_for(one, attempt)) return count(one.failed, now);
  }
  count(addresses_, attempt.address, now);
  if (!attempt.is_local && !attempt.name.empty()) count(names_, attempt.name, now);
}

void LoginLimits::succeeded(const Attempt& attempt) {
  std::erase_if(addresses_, [&](const Entry& entry) { return entry.key == attempt.address; });
  std::erase_if(familiar_, [&](const Familiar& one) { return is_for(one, attempt); });
  const auto is_of_name = [&](const Familiar& one) { return one.failed.key == attempt.name; };
  // The oldest login is in front.
  if (std::ranges::count_if(familiar_, is_of_name) >=
      static_cast<std::ptrdiff_t>(kMostFamiliarOfName)) {
    familiar_.erase(std::ranges::find_if(familiar_, is_of_name));
  } else if (familiar_.size() >= kMostFamiliar) {
    familiar_.erase(familiar_.begin());
  }
  familiar_.push_back({attempt.address, {attempt.name, 0, {}}});
}

void LoginLimits::forgive_name(const std::string& name) {
  std::erase_if(names_, [&](const Entry& entry) { return entry.key == name; });
  for (Familiar& one : familiar_) {
    if (one.failed.key == name) one.failed.failures = 0;
  }
}

void LoginLimits::restore(std::vector<Entry> names, std::vector<Entry> addresses,
                          std::vector<Familiar> familiar) {
  names_ = std::move(names);
  addresses_ = std::move(addresses);
  familiar_ = std::move(familiar);
}

}  // namespace orbwatch::app::web
