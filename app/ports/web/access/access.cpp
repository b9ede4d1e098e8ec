// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/access.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "app/log.h"
#include "app/ports/web/access/login/first_code.h"
#include "app/ports/web/access/login/kept_logins.h"
#include "app/ports/web/access/login/secret.h"
#include "app/ports/web/http/address.h"
#include "hal/network.h"

namespace orbwatch::app::web {
namespace {

std::filesystem::path logins_file(const std::filesystem::path& folder) {
  return folder / "logins.json";
}

/// Name for counting; all invalid names share one entry, so that they do not displace others.
std::string limited_name(const std::string& name) { return check_name(name) ? name : "(no name)"; }

/// Returns true for one address of 127.0.0.0/8 only, because any program of this computer can use
/// the others.
bool is_this_computer(const std::string& peer) { return peer == "127.0.0.1" || peer == "::1"; }

LoginLimits::Attempt attempt_of(const std::string& name, const std::string& peer) {
  return {limited_name(name), address_key(peer), is_this_computer(peer)};
}

LoginLimits::Attempt nameless_attempt_of(const std::string& peer) {
  return {"", address_key(peer), is_this_computer(peer)};
}

Access::Refusal too_many(const std::string& what, std::chrono::seconds wait) {
  return {429, "too many wrong " + what + "; try again in " + std::to_string(wait.count()) + " s",
          wait};
}

/// A fault of the appliance, not of the client: counts as no failed login.
Access::Refusal out_of_memory() {
  return {503,
          "the password cannot be checked: less than 64 MiB of memory is free; try again later"};
}

}  // namespace

Utc Access::utc_now() {
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
}

Access::Access(std::filesystem::path state_folder, Sessions::Limits limits, ClockOfUtc clock)
    : folder_(std::move(state_folder)), clock_(std::move(clock)), sessions_(limits) {}

void Access::start(bool gives_code) {
  if (folder_.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    const auto loaded = load_logins(logins_file(folder_), sessions_, limits_);
    if (!loaded) log_line(LogLevel::Error, "web: " + loaded.error().message);
  }
  const std::lock_guard files(files_mutex_);
  gives_code_ = gives_code;
  load(Cause::Start);
}

void Access::stop() {
  if (has_users()) keep();
}

Access::FileMark Access::mark() const {
  struct stat about {};
  if (::lstat(users_file(folder_).c_str(), &about) != 0) {
    FileMark absent;
    absent.error = errno;
    return absent;
  }
  return {0, about.st_ctim.tv_sec, about.st_ctim.tv_nsec, about.st_ino};
}

bool Access::is_outdated() const {
  if (folder_.empty()) return false;
  const FileMark present = mark();
  const std::lock_guard lock(mutex_);
  return present != mark_;
}

/// Asks the file system each time, so that trust ends with the first password, before the next
/// refresh().
bool Access::may_trust() const { return folder_.empty() || mark().error == ENOENT; }

void Access::refresh() {
  const std::lock_guard files(files_mutex_);
  if (is_outdated()) load(Cause::OtherProcess);
}

/// Loads the users. A file that is missing (unmounted, removed) after there were users is a fault;
/// it does not give access.
Result<std::optional<Users>> Access::load_checked() {
  const auto file = users_file(folder_);
  auto loaded = load_users(file);
  if (!loaded) return loaded;
  if (!*loaded) {
    if (!had_users_) return loaded;
    return fail(file.string() + ": is missing, although passwords were set");
  }
  had_users_ = true;
  if (const auto kept = keep_that_users_exist(file); !kept) {
    log_line(LogLevel::Error, "web: " + kept.error().message);
  }
  return loaded;
}

void Access::load(Cause cause) {
  const FileMark present = mark();
  auto loaded = load_checked();
  const std::string fault = loaded ? "" : loaded.error().message;
  if (!fault.empty()) log_line(LogLevel::Error, "web: login is not possible: " + fault);
  const std::string code = code_for(loaded);
  const std::lock_guard lock(mutex_);
  mark_ = present;
  code_ = code;
  fault_ = fault;
  state_ = !loaded ? State::Unusable : *loaded ? State::Users : State::Nobody;
  // Failures are kept while the file is missing or damaged.
  if (!loaded) return;
  Users now = *loaded ? std::move(**loaded) : Users{};
  forgive_new_passwords(now, cause);
  users_ = std::move(now);
}

/// Resets the limits of names with a new password; if another process set it, at the board, also
/// those of addresses, so that the user can log in at once, from anywhere.
void Access::forgive_new_passwords(const Users& now, Cause cause) {
  if (cause == Cause::Start) return;
  for (const User& user : now.users) {
    const User* before = users_.find(user.name);
    if (before && before->password == user.password) continue;
    limits_.forgive_name(user.name);
    if (cause == Cause::OtherProcess) limits_.forgive_addresses();
  }
}

/// Code for the first password; empty: there is none. It becomes invalid with the first password.
std::string Access::code_for(const Result<std::optional<Users>>& loaded) const {
  if (!loaded) return "";
  if (*loaded) {
    const auto forgotten = forget_code(folder_);
    if (!forgotten) log_line(LogLevel::Error, "web: " + forgotten.error().message);
    return "";
  }
  if (!gives_code_) return "";
  const auto code = keep_code(folder_);
  if (!code) {
    log_line(LogLevel::Error,
             "web: cannot create a code for the first password: " + code.error().message);
    return "";
  }
  log_line(LogLevel::Warning,
           "web: no password is set; another computer sets the first one with "
           "the code " +
               *code);
  return *code;
}

/// Saves sessions and limits; without the file they are lost only at a restart.
void Access::keep() {
  Sessions sessions{Sessions::Limits{}};
  LoginLimits limits;
  {
    const std::lock_guard lock(mutex_);
    sessions.restore(sessions_.all());
    limits = limits_;
  }
  // The marker is missing in a folder that was created again after its removal.
  if (has_users()) {
    const auto kept = keep_that_users_exist(users_file(folder_));
    if (!kept) log_line(LogLevel::Error, "web: " + kept.error().message);
  }
  const auto saved = save_logins(logins_file(folder_), sessions, limits);
  if (!saved) log_line(LogLevel::Error, "web: " + saved.error().message);
}

bool Access::has_users() const {
  {
    const std::lock_guard lock(mutex_);
    if (state_ != State::Nobody) return true;
  }
  return !may_trust();
}

Users Access::users() const {
  const std::lock_guard lock(mutex_);
  return state_ == State::Users ? users_ : Users{};
}

Caller Access::caller(const Credentials& credentials) {
  {
    const std::lock_guard lock(mutex_);
    if (state_ == State::Unusable) return {};
    if (state_ == State::Users && !credentials.token.empty()) {
      const ApiToken* token = users_.find_token(token_hash(credentials.token));
      return token ? Caller{token->name, token->role} : Caller{};
    }
    if (state_ == State::Users) {
      const User* user = credentials.session.empty()
                             ? nullptr
                             : sessions_.use(credentials.session, users_, clock_());
      return user ? Caller{user->name, user->role} : Caller{};
    }
  }
  const bool is_trusted = hal::is_loopback(credentials.peer) && may_trust();
  return {"", is_trusted ? Role::Administrator : Role::Nobody};
}

/// Under mutex_.
std::optional<Access::Refusal> Access::judge_login(const std::string& name,
                                                   const std::string& peer) const {
  if (state_ == State::Unusable) return Refusal{503, "login is not possible: " + fault_};
  if (state_ == State::Nobody) {
    return Refusal{409,
                   "there are no users yet: POST /api/v1/set_user, or orbwatch password, makes the "
                   "first one"};
  }
  const auto wait = limits_.wait(attempt_of(name, peer), clock_());
  if (wait.count() == 0) return std::nullopt;
  return too_many("passwords for this name or from this address", wait);
}

/// Under mutex_.
std::optional<Access::Refusal> Access::judge_first_password(const std::string& peer) const {
  if (code_.empty()) {
    return Refusal{409, "no code is valid: a password is set, or only this computer is served"};
  }
  const auto wait = limits_.wait(nameless_attempt_of(peer), clock_());
  if (wait.count() == 0) return std::nullopt;
  return too_many("codes", wait);
}

/// If the users file is not read yet, the decision is left to the desk, which reads it.
std::optional<Access::Refusal> Access::login_refusal(const std::string& name,
                                                     const std::string& peer) const {
  if (is_outdated()) return std::nullopt;
  const std::lock_guard lock(mutex_);
  return judge_login(name, peer);
}

std::optional<Access::Refusal> Access::first_password_refusal(const std::string& peer) const {
  if (is_outdated()) return std::nullopt;
  const std::lock_guard lock(mutex_);
  return judge_first_password(peer);
}

bool Access::is_familiar(const std::string& name, const std::string& peer) const {
  const std::lock_guard lock(mutex_);
  const LoginLimits::Attempt attempt = attempt_of(name, peer);
  return attempt.is_local || limits_.is_familiar(attempt);
}

/// Does not wait for the disk: counts are saved with the next login. Failures count by address
/// only, because a limit per name would let strangers lock a recorder out.
tl::expected<Caller, Access::Refusal> Access::player(const Credentials& credentials) {
  if (!credentials.is_password || !has_users()) return caller(credentials);
  const auto attempt = nameless_attempt_of(credentials.peer);
  {
    const std::lock_guard lock(mutex_);
    const auto wait = limits_.wait(attempt, clock_());
    if (wait.count() > 0) return tl::unexpected(too_many("passwords from this address", wait));
  }
  const Caller found = caller(credentials);
  if (found.role != Role::Nobody) return found;
  ++failures_;
  const std::lock_guard lock(mutex_);
  limits_.failed(attempt, clock_());
  return found;
}

tl::expected<User, Access::Refusal> Access::judge(const std::string& name,
                                                  const std::string& password,
                                                  const std::string& peer) {
  refresh();
  User user;
  {
    const std::lock_guard lock(mutex_);
    if (auto refusal = judge_login(name, peer)) return tl::unexpected(std::move(*refusal));
    if (const User* found = users_.find(name)) user = *found;
  }
  const PasswordMatch match = match_password(user.password, password);
  if (match == PasswordMatch::OutOfMemory) return tl::unexpected(out_of_memory());
  const bool is_right = match == PasswordMatch::Right;
  {
    const std::lock_guard lock(mutex_);
    if (is_right) {
      limits_.succeeded(attempt_of(name, peer));
    } else {
      limits_.failed(attempt_of(name, peer), clock_());
    }
  }
  if (is_right) return user;
  ++failures_;
  keep();
  return tl::unexpected(Refusal{401, "name or password is wrong"});
}

Access::Token Access::login(const std::string& name, const std::string& password,
                            const std::string& peer) {
  const auto user = judge(name, password, peer);
  if (!user) return tl::unexpected(user.error());
  return begin(*user);
}

std::string Access::begin(const User& user) {
  std::string token;
  {
    const std::lock_guard lock(mutex_);
    token = sessions_.begin(user, clock_());
  }
  keep();
  return token;
}

bool Access::logout(const std::string& session) {
  bool was_there = false;
  {
    const std::lock_guard lock(mutex_);
    was_there = sessions_.end(session);
  }
  if (was_there) keep();
  return was_there;
}

Access::Token Access::change_password(const std::string& name, const std::string& old_password,
                                      const std::string& new_password, const std::string& peer) {
  const auto user = judge(name, old_password, peer);
  if (!user) return tl::unexpected(user.error());
  if (auto right = check_password(new_password); !right) {
    return tl::unexpected(Refusal{400, right.error().message});
  }
  const auto hash = hash_password(new_password);
  if (!hash) return tl::unexpected(Refusal{503, hash.error().message});
  const auto changed = change([&](Users& all) -> Result<> {
    const User* present = all.find(name);
    if (!present || present->password != user->password) {
      return fail("another administrator has changed user " + name + " meanwhile");
    }
    return set_user(all, name, std::nullopt, *hash);
  });
  if (!changed) return tl::unexpected(Refusal{409, changed.error().message});
  return begin({user->name, user->role, *hash});
}

tl::expected<void, Access::Refusal> Access::judge_code(const std::string& code,
                                                       const std::string& peer) {
  {
    const std::lock_guard lock(mutex_);
    if (auto refusal = judge_first_password(peer)) return tl::unexpected(std::move(*refusal));
    if (is_code(code_, code)) return {};
    limits_.failed(nameless_attempt_of(peer), clock_());
  }
  ++failures_;
  keep();
  return tl::unexpected(Refusal{403, "the code is wrong"});
}

Access::Token Access::set_first_password(const std::string& code, const std::string& password,
                                         const std::string& peer) {
  refresh();
  if (auto right = judge_code(code, peer); !right) return tl::unexpected(right.error());
  if (auto right = check_password(password); !right) {
    return tl::unexpected(Refusal{400, right.error().message});
  }
  const auto hash = hash_password(password);
  if (!hash) return tl::unexpected(Refusal{503, hash.error().message});
  const User first{std::string(kFirstUser), Role::Administrator, *hash};
  const auto changed = change([&first](Users& all) -> Result<> {
    if (!all.users.empty()) return fail("another user has set the first password meanwhile");
    all.users.push_back(first);
    return {};
  });
  if (!changed) return tl::unexpected(Refusal{409, changed.error().message});
  {
    const std::lock_guard lock(mutex_);
    limits_.succeeded(attempt_of(first.name, peer));
  }
  return begin(first);
}

Result<> Access::change(const std::function<Result<>(Users&)>& change) {
  if (folder_.empty()) return fail("there is no state folder for users");
  auto changed = change_users(users_file(folder_), change);
  const std::lock_guard files(files_mutex_);
  load(Cause::OwnChange);
  return changed;
}

}  // namespace orbwatch::app::web
