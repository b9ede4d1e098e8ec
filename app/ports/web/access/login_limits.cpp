#include "app/ports/web/access/login_limits.h"

#include <algorithm>

namespace orbwatch::app::web {
namespace {

using std::chrono::seconds;
using Entries = std::vector<LoginLimits::Entry>;

/// Also of one from the future, after the clock was set back.
bool is_forgotten(const LoginLimits::Entry& entry, Utc now) {
  return now - entry.last >= LoginLimits::kForgetAfter ||
         entry.last - now >= LoginLimits::kForgetAfter;
}

seconds wait_of(const Entries& entries, const std::string& key, seconds longest, Utc now) {
  const auto found = std::ranges::find(entries, key, &LoginLimits::Entry::key);
  if (found == entries.end() || is_forgotten(*found, now)) return seconds(0);
  const int beyond = found->failures - LoginLimits::kFree;
  if (beyond < 0) return seconds(0);
  constexpr int kMostDoublings = 16;
  const seconds whole = std::min(longest, seconds(1 << std::min(beyond, kMostDoublings)));
  return std::clamp(found->last + whole - now, seconds(0), whole);
}

void count(Entries& entries, const std::string& key, Utc now) {
  std::erase_if(entries, [&](const auto& entry) { return is_forgotten(entry, now); });
  const auto found = std::ranges::find(entries, key, &LoginLimits::Entry::key);
  if (found != entries.end()) {
    ++found->failures;
    found->last = now;
    return;
  }
  if (entries.size() >= LoginLimits::kMostKept) {
    entries.erase(std::ranges::min_element(entries, {}, &LoginLimits::Entry::last));
  }
  entries.push_back({key, 1, now});
}

}  // namespace

seconds LoginLimits::wait(const std::string& name, const std::string& address, Utc now) const {
  return std::max(wait_of(names_, name, kLongestForName, now),
                  wait_of(addresses_, address, kLongestForAddress, now));
}

void LoginLimits::failed(const std::string& name, const std::string& address, Utc now) {
  count(names_, name, now);
  count(addresses_, address, now);
}

void LoginLimits::succeeded(const std::string& name) {
  std::erase_if(names_, [&](const Entry& entry) { return entry.key == name; });
}

void LoginLimits::restore(std::vector<Entry> names, std::vector<Entry> addresses) {
  names_ = std::move(names);
  addresses_ = std::move(addresses);
}

}  // namespace orbwatch::app::web
