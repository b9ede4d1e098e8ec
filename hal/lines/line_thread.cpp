// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/line_thread.h"

#include <sys/epoll.h>
#include <sys/timerfd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <system_error>

namespace orbwatch::hal {
namespace {

bool poll_for_input(const FileDescriptor& poll, int file, void* who) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.ptr = who;
  return ::epoll_ctl(poll.get(), EPOLL_CTL_ADD, file, &event) == 0;
}

/// A zero time would disarm the timer, so it is never set.
itimerspec alarm_at(TimePoint moment) {
  const auto age = std::max(std::chrono::nanoseconds(1),
                            std::chrono::ceil<std::chrono::nanoseconds>(moment.time_since_epoch()));
  itimerspec setting{};
  setting.it_value.tv_sec = static_cast<std::time_t>(age / std::chrono::seconds(1));
  setting.it_value.tv_nsec = static_cast<long>((age % std::chrono::seconds(1)).count());
  return setting;
}

}  // namespace

Result<> LineThread::start(std::string_view name) {
  poll_ = FileDescriptor(::epoll_create1(EPOLL_CLOEXEC));
  timer_ = FileDescriptor(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC));
  if (!poll_.is_open() || !woken_.is_open() || !timer_.is_open() ||
      !poll_for_input(poll_, woken_.get(), nullptr) ||
      !poll_for_input(poll_, timer_.get(), nullptr)) {
    return fail(std::string(name) + ": " + std::generic_category().message(errno));
  }
  for (Watched& watched : watched_) watched.registered = 0;
  thread_.start(name, ThreadRole::Lines, [this] { run(); });
  return {};
}

void LineThread::run() {
  const std::stop_callback wake_to_stop(thread_.stop_token(), [this] { wake(); });
  while (!thread_.stop_requested()) {
    poll_open_files();
    set_timer();
    wait();
    run_due();
  }
}

/// Adds files that were opened since the last time; the kernel removes closed ones.
void LineThread::poll_open_files() {
  for (Watched& watched : watched_) {
    const WatchedInput& input = *watched.input;
    if (input.descriptor() < 0 || watched.registered == input.opened()) continue;
    if (poll_for_input(poll_, input.descriptor(), watched.input)) {
      watched.registered = input.opened();
    }
  }
}

TimePoint LineThread::next_due() const {
  TimePoint next = TimePoint::max();
  for (const Watched& watched : watched_) next = std::min(next, watched.input->due());
  for (const LineTask* task : tasks_) next = std::min(next, task->due());
  return next;
}

void LineThread::set_timer() {
  const TimePoint next = next_due();
  const itimerspec setting = next == TimePoint::max() ? itimerspec{} : alarm_at(next);
  ::timerfd_settime(timer_.get(), TFD_TIMER_ABSTIME, &setting, nullptr);  // also clears it
}

/// Waits for edges, the timer or wake(), and reads the edges.
void LineThread::wait() {
  std::array<epoll_event, 16> events;
  const int count = ::epoll_wait(poll_.get(), events.data(), static_cast<int>(events.size()), -1);
  woken_.clear();
  for (int i = 0; i < count; ++i) {
    auto* input = static_cast<WatchedInput*>(events[static_cast<std::size_t>(i)].data.ptr);
    if (input) input->read(Clock::now());
  }
}

void LineThread::run_due() {
  for (const Watched& watched : watched_) watched.input->run(Clock::now());
  for (LineTask* task : tasks_) task->run(Clock::now());
}

}  // namespace orbwatch::hal
