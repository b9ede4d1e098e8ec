#include "app/ports/web/access/slow_work.h"

#include <utility>

namespace orbwatch::app::web {

void SlowWork::start() {
  thread_.start(thread_name_, hal::ThreadRole::Background, [this] {
    while (thread_.wait()) work_all();
  });
}

void SlowWork::run(const ExchangePtr& exchange, std::function<Response()> work) {
  bool is_full = false;
  {
    const std::lock_guard lock(mutex_);
    is_full = waiting_.size() == kMostWaiting;
    if (!is_full) waiting_.push_back({exchange, std::move(work)});
  }
  if (!is_full) return thread_.wake();
  Response response = error_response(503, busy_);
  response.headers.emplace_back("Retry-After", "1");
  exchange->answer(std::move(response));
}

void SlowWork::work_all() {
  while (!thread_.stop_requested()) {
    Waiting next;
    {
      const std::lock_guard lock(mutex_);
      if (waiting_.empty()) return;
      next = std::move(waiting_.front());
      waiting_.pop_front();
    }
    if (next.exchange->begin_effect()) next.exchange->answer(next.work());
  }
}

}  // namespace orbwatch::app::web
