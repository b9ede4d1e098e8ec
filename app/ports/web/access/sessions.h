#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/web/access/login_limits.h"
#include "app/ports/web/access/users.h"

namespace orbwatch::app::web {

/// Who has logged in. A session ends when it is unused for long, at its greatest age, when its user
/// is gone and when the user's password has changed. Thread-bound.
class Sessions {
 public:
  /// Of one user; one more ends the one that was unused longest.
  static constexpr std::size_t kMostOfUser = 32;

  struct Limits {
    std::chrono::seconds idle{};
    std::chrono::seconds age{};
  };
  struct Session {
    std::string hash;  ///< of its token, which nobody keeps
    std::string user;
    std::string password;  ///< token_hash() of the user's password as it is kept
    Utc begun{};
    Utc used{};
  };

  explicit Sessions(Limits limits) : limits_(limits) {}

  /// Returns the token.
  std::string begin(const User& user, Utc now);
  /// The user of a session, which is used by that; null: there is none such.
  const User* use(std::string_view token, const Users& users, Utc now);
  /// False: there is none such.
  bool end(std::string_view token);

  /// For the disk.
  const std::vector<Session>& all() const { return all_; }
  void restore(std::vector<Session> all) { all_ = std::move(all); }

 private:
  bool has_ended(const Session& session, Utc now) const;

  const Limits limits_;
  std::vector<Session> all_;
};

}  // namespace orbwatch::app::web
