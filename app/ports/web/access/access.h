// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "app/ports/web/access/caller.h"
#include "app/ports/web/access/login/login_limits.h"
#include "app/ports/web/access/login/sessions.h"
#include "app/ports/web/access/users.h"

namespace orbwatch::app::web {

/// Authenticates callers by the users file of the state folder. Until a first password is set
/// there, callers on this computer are administrators and others have no role; if the file is
/// unusable, or missing after it existed, no caller has a role.
///
/// Thread rule: caller, player, login_refusal, first_password_refusal, is_familiar, has_users,
/// failures and users on any thread, without waiting; refresh on any thread, it waits for the disk;
/// everything else on one thread at a time, waiting for the disk, login and change_password also
/// for a hash.
class Access {
 public:
  /// Reason of a refused login.
  struct Refusal {
    int status = 0;  ///< HTTP status
    std::string what;
    std::chrono::seconds retry_after{0};
  };
  using Token = tl::expected<std::string, Refusal>;
  using ClockOfUtc = std::function<Utc()>;

  /// `state_folder` empty: passwords cannot be set.
  Access(std::filesystem::path state_folder, Sessions::Limits limits, ClockOfUtc clock = utc_now);

  /// Reads the files; logs errors. `gives_code`: while there are no users, logs the code with which
  /// another computer sets the first password.
  void start(bool gives_code = false);
  /// Saves the times of the sessions' last use.
  void stop();
  /// Reads the users again if their file has changed.
  void refresh();

  /// The caller with its role. Trust without a password ends when the users file appears, before
  /// refresh() reads it.
  Caller caller(const Credentials& credentials);
  /// Like caller(), and an invalid token sent as a password counts as a failed login of its
  /// address. Refusal: 429, the address has too many failures.
  tl::expected<Caller, Refusal> player(const Credentials& credentials);
  /// Returns whether there are users, also before refresh() reads a new users file.
  bool has_users() const;
  /// Number of wrong passwords and codes since the start.
  std::uint64_t failures() const { return failures_; }

  /// The refusal that login() and set_first_password() give for any password or code at present;
  /// nullopt: the secret is checked.
  std::optional<Refusal> login_refusal(const std::string& name, const std::string& peer) const;
  std::optional<Refusal> first_password_refusal(const std::string& peer) const;
  /// Returns whether the name has logged in from this address before, or the address is this
  /// computer.
  bool is_familiar(const std::string& name, const std::string& peer) const;

  /// Logs in; returns the token of a new session.
  Token login(const std::string& name, const std::string& password, const std::string& peer);
  /// Ends a session. False: there was no such session.
  bool logout(const std::string& session);
  /// Changes a password given the present one; ends the user's sessions and starts a new one.
  Token change_password(const std::string& name, const std::string& old_password,
                        const std::string& new_password, const std::string& peer);
  /// Creates the first user, kFirstUser, given the code, and starts a session.
  Token set_first_password(const std::string& code, const std::string& password,
                           const std::string& peer);
  /// Changes the users. Errors: those of change_users().
  Result<> change(const std::function<Result<>(Users&)>& change);
  /// Present users; none if the file is absent or unusable.
  Users users() const;

  static Utc utc_now();

 private:
  /// Identifies a version of the users file.
  struct FileMark {
    int error = 0;  ///< errno of lstat; 0: the file exists
    /// Time of the newest change, including permissions.
    std::int64_t seconds = 0, nanoseconds = 0;
    std::uint64_t number = 0;
    bool operator==(const FileMark&) const = default;
  };
  enum class State { Nobody, Users, Unusable };
  enum class Cause { Start, OwnChange, OtherProcess };

  FileMark mark() const;
  bool is_outdated() const;
  bool may_trust() const;
  void load(Cause cause);                                     ///< under files_mutex_
  Result<std::optional<Users>> load_checked();                ///< under files_mutex_
  void forgive_new_passwords(const Users& now, Cause cause);  ///< under mutex_
  std::optional<Refusal> judge_login(const std::string& name, const std::string& peer) const;
  std::optional<Refusal> judge_first_password(const std::string& peer) const;
  std::string code_for(const Result<std::optional<Users>>& loaded) const;
  tl::expected<void, Refusal> judge_code(const std::string& code, const std::string& peer);
  void keep();
  std::string begin(const User& user);
  tl::expected<User, Refusal> judge(const std::string& name, const std::string& password,
                                    const std::string& peer);

  const std::filesystem::path folder_;
  const ClockOfUtc clock_;
  std::mutex files_mutex_;   ///< held also while the users file is read; locked before mutex_
  bool gives_code_ = false;  ///< under files_mutex_
  bool had_users_ = false;   ///< under files_mutex_

  std::atomic<std::uint64_t> failures_{0};

  /// Guards the following members; never held while waiting for the disk or a hash.
  mutable std::mutex mutex_;
  FileMark mark_;  ///< mark of the users file that was read
  State state_ = State::Nobody;
  std::string fault_;
  Users users_;       ///< newest users read
  std::string code_;  ///< code for the first password; empty: none
  Sessions sessions_;
  LoginLimits limits_;
};

}  // namespace orbwatch::app::web
