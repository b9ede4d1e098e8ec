#include "app/cli/cancelled.h"

#include <csignal>

namespace orbwatch::app {
namespace {

std::atomic<bool> cancelled{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

void cancel(int) { cancelled = true; }

}  // namespace

const std::atomic<bool>& cancelled_by_signal() {
  std::signal(SIGINT, cancel);
  std::signal(SIGTERM, cancel);
  return cancelled;
}

}  // namespace orbwatch::app
