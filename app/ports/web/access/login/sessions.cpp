// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/login/sessions.h"

#include <algorithm>

#include "app/ports/web/access/login/secret.h"

namespace orbwatch::app::web {

std::string Sessions::begin(const User& user, Utc now) {
  std::erase_if(all_, [&](const Session& session) { return has_ended(session, now); });
  if (std::ranges::count(all_, user.name, &Session::user) >=
      static_cast<std::ptrdiff_t>(kMostOfUser)) {
    auto longest = all_.end();
    for (auto one = all_.begin(); one != all_.end(); ++one) {
      const bool is_of_user = one->user == user.name;
      if (is_of_user && (longest == all_.end() || one->used < longest->used)) longest = one;
    }
    all_.erase(longest);
  }
  std::string token = random_token();
  all_.push_back({token_hash(token), user.name, token_hash(user.password), now, now});
  return token;
}

const User* Sessions::use(std::string_view token, const Users& users, Utc now) {
  const auto found = std::ranges::find(all_, token_hash(token), &Session::hash);
  if (found == all_.end()) return nullptr;
  const User* user = users.find(found->user);
  if (!user || has_ended(*found, now) || token_hash(user->password) != found->password) {
    all_.erase(found);
    return nullptr;
  }
  found->used = now;
  return user;
}

bool Sessions::end(std::string_view token) {
  const std::string hash = token_hash(token);
  return std::erase_if(all_, [&](const Session& one) { return one.hash == hash; }) > 0;
}

/// Returns whether a session has ended, or is from the future after the clock was set back.
bool Sessions::has_ended(const Session& session, Utc now) const {
  return now - session.used >= limits_.idle || now - session.begun >= limits_.age ||
         session.begun - now >= limits_.idle;
}

}  // namespace orbwatch::app::web
