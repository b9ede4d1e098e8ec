#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace orbwatch::app::web {

using Utc = std::chrono::sys_seconds;

/// Slows guessing of passwords and codes down. After kFree failures each further one doubles the
/// wait. Failures from an address where the name has logged in before (familiar) count for the two
/// together, so that nobody else makes the user wait there. Those from anywhere else count for the
/// address, and for the name from all such addresses together, so that many addresses guess no
/// faster than one; those from this computer for the address alone. A success forgives the address.
/// An hour without a failure forgets. Thread-bound.
class LoginLimits {
 public:
  static constexpr int kFree = 5;
  /// Longest waits: of all unfamiliar addresses for a name, of a familiar one, of this computer.
  static constexpr std::chrono::seconds kLongestForName{60};
  static constexpr std::chrono::seconds kLongestForAddress{900};
  static constexpr std::chrono::seconds kForgetAfter{3600};
  /// Limit for names and for addresses; one more replaces the one with the fewest failures.
  static constexpr std::size_t kMostKept = 512;
  /// Limits for familiar addresses; one more replaces the one whose login is longest ago.
  static constexpr std::size_t kMostFamiliarOfName = 8;
  static constexpr std::size_t kMostFamiliar = 512;

  /// A name or the code that is tried, and the address it comes from.
  struct Attempt {
    std::string name;       ///< of a user; empty: the code for the first password
    std::string address;    ///< address_key() of the client
    bool is_local = false;  ///< from this computer
  };
  struct Entry {
    std::string key;
    int failures = 0;
    Utc last{};  ///< failure
  };
  struct Familiar {
    std::string address;
    Entry failed;  ///< its key is the name
  };

  /// Time until the next attempt is allowed; 0: now.
  std::chrono::seconds wait(const Attempt& attempt, Utc now) const;
  void failed(const Attempt& attempt, Utc now);
  /// A login with the right password.
  void succeeded(const Attempt& attempt);
  bool is_familiar(const Attempt& attempt) const;
  /// The name has another password: nobody waits for it.
  void forgive_name(const std::string& name);
  void forgive_addresses() { addresses_.clear(); }

  /// For the disk.
  const std::vector<Entry>& names() const { return names_; }
  const std::vector<Entry>& addresses() const { return addresses_; }
  const std::vector<Familiar>& familiar() const { return familiar_; }
  void restore(std::vector<Entry> names, std::vector<Entry> addresses,
               std::vector<Familiar> familiar);

 private:
  const Familiar* find_familiar(const Attempt& attempt) const;

  std::vector<Entry> names_;
  std::vector<Entry> addresses_;
  std::vector<Familiar> familiar_;  ///< newest login last
};

}  // namespace orbwatch::app::web
