// SPDX-License-Identifier: Apache-2.0
#include "tests/support/abuse.h"

namespace orbwatch::tests {

Abused::Abused(const Abuse& abuse, int port) : thread_([this, abuse, port] { run(abuse, port); }) {}

Abused::~Abused() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Abused::run(const Abuse& abuse, int port) {
  const auto abusers = abuse.begin(port);
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, abuse.pause, [this] { return is_ended_; })) {
    lock.unlock();
    abusers->act();
    ++acts_;
    lock.lock();
  }
}

}  // namespace orbwatch::tests
