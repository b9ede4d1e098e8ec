// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace orbwatch::app::web {

using Utc = std::chrono::sys_seconds;

/// Limits the rate of guessing passwords and codes. After kFree failures each further one doubles
/// the wait. Failures from an address from which the name has logged in before (familiar) count for
/// the pair, so that others cannot make the user wait there. Failures from other addresses count
/// for the address, and for the name over all such addresses, so that many addresses guess no
/// faster than one; those from this computer count for the address only. A success resets the
/// address. An hour without a failure resets a count. Thread-bound.
class LoginLimits {
 public:
  static constexpr int kFree = 5;
  /// Longest waits: for a name over all unfamiliar addresses, for a familiar address, for this
  /// computer.
  static constexpr std::chrono::seconds kLongestForName{60};
  static constexpr std::chrono::seconds kLongestForAddress{900};
  static constexpr std::chrono::seconds kForgetAfter{3600};
  /// Limit for names and for addresses; a further one replaces the one with the fewest failures.
  static constexpr std::size_t kMostKept = 512;
  /// Limits for familiar addresses; a further one replaces the one with the oldest login.
  static constexpr std::size_t kMostFamiliarOfName = 8;
  static constexpr std::size_t kMostFamiliar = 512;

  /// An attempt with a name or the code, and its address.
  struct Attempt {
    std::string name;       ///< name of a user; empty: the code for the first password
    std::string address;    ///< address_key() of the client
    bool is_local = false;  ///< the attempt comes from this computer
  };
  struct Entry {
    std::string key;
    int failures = 0;
    Utc last{};  ///< time of the last failure
  };
  struct Familiar {
    std::string address;
    Entry failed;  ///< its key is the name
  };

  /// Time until the next attempt is allowed; 0: now.
  std::chrono::seconds wait(const Attempt& attempt, Utc now) const;
  void failed(const Attempt& attempt, Utc now);
  /// Reports a login with the right password.
  void succeeded(const Attempt& attempt);
  bool is_familiar(const Attempt& attempt) const;
  /// Resets a name, after a change of its password.
  void forgive_name(const std::string& name);
  void forgive_addresses() { addresses_.clear(); }

  /// Failures by name, for saving.
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
