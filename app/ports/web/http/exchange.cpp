// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/exchange.h"

#include <microhttpd.h>

#include "app/ports/web/http/content_coding.h"
#include "app/ports/web/http/entity_tag.h"

namespace orbwatch::app::web {

void Exchange::send_file_while(std::function<bool()> may_go_on) {
  const std::lock_guard lock(mutex_);
  file_may_go_on_ = std::move(may_go_on);
}

bool Exchange::answer(Response response) {
  // The time of compression is spent outside the lock.
  response = packed_for(request_, if_none_match(request_, std::move(response)));
  const std::lock_guard lock(mutex_);
  return answer_locked(std::move(response));
}

bool Exchange::begin_effect() {
  const std::lock_guard lock(mutex_);
  if (is_answered_) return false;
  has_effect_ = true;
  return true;
}

bool Exchange::give_up(Response response) {
  const std::lock_guard lock(mutex_);
  return !has_effect_ && answer_locked(std::move(response));
}

bool Exchange::answer_locked(Response response) {
  if (is_answered_) return false;
  is_answered_ = true;
  if (response.file && !response.may_go_on) response.may_go_on = std::move(file_may_go_on_);
  response_ = std::move(response);
  if (suspended_) ::MHD_resume_connection(std::exchange(suspended_, nullptr));
  return true;
}

bool Exchange::is_answered() const {
  const std::lock_guard lock(mutex_);
  return is_answered_;
}

std::optional<Response> Exchange::response_or_suspend(MHD_Connection* connection) {
  const std::lock_guard lock(mutex_);
  if (is_answered_) return std::exchange(response_, std::nullopt);
  suspended_ = connection;
  ::MHD_suspend_connection(connection);
  return std::nullopt;
}

}  // namespace orbwatch::app::web
