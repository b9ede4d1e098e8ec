#include "app/ports/web/access/access.h"

#include <sys/stat.h>

#include <utility>

#include "app/log.h"
#include "app/ports/web/access/first_code.h"
#include "app/ports/web/access/kept_logins.h"
#include "app/ports/web/access/secret.h"
#include "app/ports/web/http/address.h"

namespace orbwatch::app::web {
namespace {

std::filesystem::path logins_file(const std::filesystem::path& folder) {
  return folder / "logins.json";
}

/// One for all that cannot be a name, so that they take no place of others.
std::string limited_name(const std::string& name) { return check_name(name) ? name : "(no name)"; }

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
  load();
}

void Access::stop() {
  if (has_users()) keep();
}

Access::FileMark Access::mark() const {
  struct stat about {};
  if (::stat(users_file(folder_).c_str(), &about) != 0) return {};
  return {about.st_mtim.tv_sec, about.st_mtim.tv_nsec, about.st_size, about.st_ino};
}

void Access::refresh() {
  const std::lock_guard files(files_mutex_);
  if (!folder_.empty() && mark() != mark_) load();
}

void Access::load() {
  mark_ = mark();
  auto loaded = load_users(users_file(folder_));
  const std::string fault = loaded ? "" : loaded.error().message;
  if (!fault.empty()) log_line(LogLevel::Error, "web: nobody can log in: " + fault);
  const std::string code = code_for(loaded);
  const std::lock_guard lock(mutex_);
  code_ = code;
  fault_ = fault;
  state_ = !loaded ? State::Unusable : *loaded ? State::Users : State::Nobody;
  users_ = loaded && *loaded ? std::move(**loaded) : Users{};
}

/// Empty: there is none. It ends with the first password.
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
    log_line(LogLevel::Error, "web: no code for the first password: " + code.error().message);
    return "";
  }
  log_line(LogLevel::Warning,
           "web: no password is set; another computer sets the first one with "
           "the code " +
               *code);
  return *code;
}

/// Without the file only a restart would forget.
void Access::keep() {
  Sessions sessions{Sessions::Limits{}};
  LoginLimits limits;
  {
    const std::lock_guard lock(mutex_);
    sessions.restore(sessions_.all());
    limits = limits_;
  }
  const auto saved = save_logins(logins_file(folder_), sessions, limits);
  if (!saved) log_line(LogLevel::Error, "web: " + saved.error().message);
}

bool Access::has_users() const {
  const std::lock_guard lock(mutex_);
  return state_ != State::Nobody;
}

Users Access::users() const {
  const std::lock_guard lock(mutex_);
  return users_;
}

Caller Access::caller(const Credentials& credentials) {
  const std::lock_guard lock(mutex_);
  if (state_ == State::Unusable) return {};
  if (state_ == State::Nobody) {
    return {"", is_loopback(credentials.peer) ? Role::Administrator : Role::Nobody};
  }
  if (!credentials.token.empty()) {
    const ApiToken* token = users_.find_token(token_hash(credentials.token));
    return token ? Caller{token->name, token->role} : Caller{};
  }
  if (credentials.session.empty()) return {};
  const User* user = sessions_.use(credentials.session, users_, clock_());
  return user ? Caller{user->name, user->role} : Caller{};
}

tl::expected<User, Access::Refusal> Access::judge(const std::string& name,
                                                  const std::string& password,
                                                  const std::string& peer) {
  refresh();
  const std::string limited = limited_name(name), address = address_key(peer);
  User user;
  {
    const std::lock_guard lock(mutex_);
    if (state_ == State::Unusable) {
      return tl::unexpected(Refusal{503, "nobody can log in: " + fault_});
    }
    if (state_ == State::Nobody) {
      return tl::unexpected(Refusal{409,
                                    "there are no users yet: POST /api/v1/set_user, or orbwatch "
                                    "password, makes the first one"});
    }
    if (const auto wait = limits_.wait(limited, address, clock_()); wait.count() > 0) {
      return tl::unexpected(Refusal{429,
                                    "too many wrong passwords for this name or from this address; "
                                    "try again in " +
                                        std::to_string(wait.count()) + " s",
                                    wait});
    }
    if (const User* found = users_.find(name)) user = *found;
  }
  const bool is_right = is_password(user.password, password);
  {
    const std::lock_guard lock(mutex_);
    if (is_right) {
      limits_.succeeded(limited);
    } else {
      limits_.failed(limited, address, clock_());
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

void Access::logout(const std::string& session) {
  {
    const std::lock_guard lock(mutex_);
    sessions_.end(session);
  }
  keep();
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
      return fail("somebody else has changed user " + name + " meanwhile");
    }
    return set_user(all, name, std::nullopt, *hash);
  });
  if (!changed) return tl::unexpected(Refusal{409, changed.error().message});
  return begin({user->name, user->role, *hash});
}

tl::expected<void, Access::Refusal> Access::judge_code(const std::string& code,
                                                       const std::string& peer) {
  // No user's name, so that its failures count by themselves.
  static const std::string kCode = "(first code)";
  const std::string address = address_key(peer);
  {
    const std::lock_guard lock(mutex_);
    if (code_.empty()) {
      return tl::unexpected(Refusal{409,
                                    "no code is valid: a password is set, or only this "
                                    "computer is served"});
    }
    if (const auto wait = limits_.wait(kCode, address, clock_()); wait.count() > 0) {
      return tl::unexpected(Refusal{
          429, "too many wrong codes; try again in " + std::to_string(wait.count()) + " s", wait});
    }
    if (is_code(code_, code)) return {};
    limits_.failed(kCode, address, clock_());
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
    if (!all.users.empty()) return fail("somebody else has set the first password meanwhile");
    all.users.push_back(first);
    return {};
  });
  if (!changed) return tl::unexpected(Refusal{409, changed.error().message});
  return begin(first);
}

Result<> Access::change(const std::function<Result<>(Users&)>& change) {
  if (folder_.empty()) return fail("there is no state folder to keep users in");
  auto changed = change_users(users_file(folder_), change);
  const std::lock_guard files(files_mutex_);
  load();
  return changed;
}

}  // namespace orbwatch::app::web
