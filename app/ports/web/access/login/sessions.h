// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/web/access/login/login_limits.h"
#include "app/ports/web/access/users.h"

namespace orbwatch::app::web {

/// Sessions of logged-in users. A session ends when it is idle too long, at its largest age, when
/// its user is removed and when the user's password changes. Thread-bound.
class Sessions {
 public:
  /// Limit of sessions of one user; a further one ends the one idle longest.
  static constexpr std::size_t kMostOfUser = 32;

  struct Limits {
    std::chrono::seconds idle{};
    std::chrono::seconds age{};
  };
  struct Session {
    std::string hash;  ///< hash of its token; the token itself is not stored
    std::string user;
    std::string password;  ///< token_hash() of the user's stored password hash
    Utc begun{};
    Utc used{};
  };

  explicit Sessions(Limits limits) : limits_(limits) {}

  /// Starts a session; returns its token.
  std::string begin(const User& user, Utc now);
  /// Returns the user of a session and marks it as used; null: unknown session.
  const User* use(std::string_view token, const Users& users, Utc now);
  /// Ends a session. False: unknown session.
  bool end(std::string_view token);

  /// All sessions, for saving.
  const std::vector<Session>& all() const { return all_; }
  void restore(std::vector<Session> all) { all_ = std::move(all); }

 private:
  bool has_ended(const Session& session, Utc now) const;

  const Limits limits_;
  std::vector<Session> all_;
};

}  // namespace orbwatch::app::web
