// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/slow_work.h"

#include <algorithm>
#include <utility>

namespace orbwatch::app::web {

void SlowWork::start() {
  thread_.start(thread_name_, hal::ThreadRole::Background, [this] {
    while (thread_.wait()) work_all();
  });
}

void SlowWork::run(const ExchangePtr& exchange, const Asker& asker,
                   std::function<Response()> work) {
  bool is_full = false;
  {
    const std::lock_guard lock(mutex_);
    Queue& queue = asker.is_known ? known_ : unknown_;
    const auto own = static_cast<std::size_t>(std::ranges::count(queue, asker.key, &Waiting::key));
    is_full =
        queue.size() == kMostWaiting || own >= (asker.is_known ? kMostOfKnown : kMostOfUnknown);
    if (!is_full) queue.push_back({asker.key, exchange, std::move(work)});
  }
  if (!is_full) return thread_.wake();
  Response response = error_response(503, busy_);
  response.headers.emplace_back("Retry-After", "1");
  exchange->answer(std::move(response));
}

SlowWork::Queue& SlowWork::next_queue() {
  const bool is_turn_of_unknown = was_known_ && !unknown_.empty();
  was_known_ = !known_.empty() && !is_turn_of_unknown;
  return was_known_ ? known_ : unknown_;
}

void SlowWork::work_all() {
  while (!thread_.stop_requested()) {
    Waiting next;
    {
      const std::lock_guard lock(mutex_);
      Queue& queue = next_queue();
      if (queue.empty()) return;
      next = std::move(queue.front());
      queue.pop_front();
    }
    if (next.exchange->begin_effect()) next.exchange->answer(next.work());
  }
}

}  // namespace orbwatch::app::web
