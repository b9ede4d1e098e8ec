#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace orbwatch::app::web {

using Utc = std::chrono::sys_seconds;

/// Slows guessing of passwords down. After kFree failures for a name or from an address each
/// further one doubles the wait, for a name up to a minute, so that nobody locks others out for
/// long, for an address up to a quarter of an hour. An hour without a failure forgets them.
/// Thread-bound.
class LoginLimits {
 public:
  static constexpr int kFree = 5;
  static constexpr std::chrono::seconds kLongestForName{60};
  static constexpr std::chrono::seconds kLongestForAddress{900};
  static constexpr std::chrono::seconds kForgetAfter{3600};
  /// Of names and of addresses; one more forgets the one whose failure is longest ago.
  static constexpr std::size_t kMostKept = 512;

  struct Entry {
    std::string key;
    int failures = 0;
    Utc last{};  ///< failure
  };

  /// How long it takes until the next try is allowed; 0: now.
  std::chrono::seconds wait(const std::string& name, const std::string& address, Utc now) const;
  void failed(const std::string& name, const std::string& address, Utc now);
  /// Forgets the name's failures; an address may go on guessing others.
  void succeeded(const std::string& name);

  /// For the disk.
  const std::vector<Entry>& names() const { return names_; }
  const std::vector<Entry>& addresses() const { return addresses_; }
  void restore(std::vector<Entry> names, std::vector<Entry> addresses);

 private:
  std::vector<Entry> names_;
  std::vector<Entry> addresses_;
};

}  // namespace orbwatch::app::web
