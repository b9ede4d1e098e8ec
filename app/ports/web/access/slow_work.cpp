// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/slow_work.h"

#include <new>
#include <utility>

namespace orbwatch::app::web {
namespace {

/// Answer of `work`. One that finds no memory, such as for pictures of a recording of any origin,
/// must not end the daemon.
Response answer_of(const std::function<Response()>& work) try {
  return work();
} catch (const std::bad_alloc&) {
  return error_response(503, "not enough memory for this request; try again later");
}

}  // namespace

void SlowWork::start() {
  thread_.start(thread_name_, hal::ThreadRole::Background, [this] {
    while (thread_.wait()) work_all();
  });
}

void SlowWork::run(const ExchangePtr& exchange, const Asker& asker,
                   std::function<Response()> work) {
  const std::size_t most = asker.is_known ? most_of_known_ : kMostOfUnknown;
  const auto is_own = [&asker](const Waiting& waiting) { return waiting.key == asker.key; };
  if ((asker.is_known ? known_ : unknown_)
          .put({asker.key, exchange, std::move(work)}, most, is_own)) {
    return thread_.wake();
  }
  Response response = error_response(503, busy_);
  response.headers.emplace_back("Retry-After", "1");
  exchange->answer(std::move(response));
}

/// The next request, in turn of both queues; nullopt: none waits.
std::optional<SlowWork::Waiting> SlowWork::next() {
  auto found = (was_known_ ? unknown_ : known_).try_take();
  if (!found) return (was_known_ ? known_ : unknown_).try_take();
  was_known_ = !was_known_;
  return found;
}

void SlowWork::work_all() {
  while (!thread_.stop_requested()) {
    const auto next = this->next();
    if (!next) return;
    if (next->exchange->begin_effect()) next->exchange->answer(answer_of(next->work));
  }
}

}  // namespace orbwatch::app::web
