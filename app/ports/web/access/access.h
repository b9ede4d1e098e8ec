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
#include "app/ports/web/access/login_limits.h"
#include "app/ports/web/access/sessions.h"
#include "app/ports/web/access/users.h"

namespace orbwatch::app::web {

/// Says who a caller is, by the users file of the state folder. Until a first password is set
/// there, whoever is on this computer is administrator and nobody else is anything; a file that
/// cannot be used, or is gone after it has been there, makes everybody nobody.
///
/// Thread rule: caller, player, login_refusal, first_password_refusal, is_familiar, has_users,
/// failures and users on any thread, they wait for nothing; refresh on any thread, too, it waits
/// for the disk; the rest on one thread at a time, it waits for the disk, login and change_password
/// for a hash, too.
class Access {
 public:
  /// Why somebody was not let in.
  struct Refusal {
    int status = 0;  ///< of HTTP
    std::string what;
    std::chrono::seconds retry_after{0};
  };
  using Token = tl::expected<std::string, Refusal>;
  using ClockOfUtc = std::function<Utc()>;

  /// `state_folder` empty: nobody can set a password.
  Access(std::filesystem::path state_folder, Sessions::Limits limits, ClockOfUtc clock = utc_now);

  /// Reads the files. Complains in the log. `gives_code`: as long as there are no users it logs the
  /// code with which another computer sets the first password.
  void start(bool gives_code = false);
  /// Keeps when sessions were used last.
  void stop();
  /// Reads the users again when their file has changed.
  void refresh();

  /// Trust without a password ends when the users file appears, before refresh() reads it.
  Caller caller(const Credentials& credentials);
  /// The same, and a token that came as a password and is none counts as a failed login of its
  /// address. Refusal: 429, its address has too many of them.
  tl::expected<Caller, Refusal> player(const Credentials& credentials);
  bool has_users() const;
  /// Wrong passwords and codes since start.
  std::uint64_t failures() const { return failures_; }

  /// The refusal with which login() and set_first_password() answer any password or code at
  /// present; nullopt: they judge it.
  std::optional<Refusal> login_refusal(const std::string& name, const std::string& peer) const;
  std::optional<Refusal> first_password_refusal(const std::string& peer) const;
  /// True: the name has logged in before from this address, or it is this computer.
  bool is_familiar(const std::string& name, const std::string& peer) const;

  /// The token of a new session.
  Token login(const std::string& name, const std::string& password, const std::string& peer);
  /// False: there was no such session.
  bool logout(const std::string& session);
  /// Of whoever knows the present one; ends the sessions of the user and begins a new one.
  Token change_password(const std::string& name, const std::string& old_password,
                        const std::string& new_password, const std::string& peer);
  /// Makes the first user, kFirstUser, for whoever knows the code, and begins a session.
  Token set_first_password(const std::string& code, const std::string& password,
                           const std::string& peer);
  /// Errors: as change_users().
  Result<> change(const std::function<Result<>(Users&)>& change);
  /// As they are now; nobody when the file is absent or cannot be used.
  Users users() const;

  static Utc utc_now();

 private:
  /// Identifies a version of the users file.
  struct FileMark {
    int error = 0;                              ///< of lstat; 0: the file is there
    std::int64_t seconds = 0, nanoseconds = 0;  ///< of the newest change, rights included
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
  std::mutex files_mutex_;   ///< also while the users file is read; before mutex_
  bool gives_code_ = false;  ///< under files_mutex_
  bool had_users_ = false;   ///< under files_mutex_

  std::atomic<std::uint64_t> failures_{0};

  mutable std::mutex
      mutex_;      ///< of what follows; never held while the disk or a hash is waited for
  FileMark mark_;  ///< of the users file as it was read
  State state_ = State::Nobody;
  std::string fault_;
  Users users_;       ///< the newest that were read
  std::string code_;  ///< for the first password; empty: there is none
  Sessions sessions_;
  LoginLimits limits_;
};

}  // namespace orbwatch::app::web
