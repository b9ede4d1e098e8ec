// SPDX-License-Identifier: Apache-2.0
#include "app/cli/program.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>
#include <opencv2/core/utility.hpp>

#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/exit_status.h"

namespace orbwatch::app::cli {
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

int run_program(const char* name, const Arguments& arguments,
                CliResult<std::string> (*run)(const Arguments& arguments)) try {
  // A command may run beside orbwatchd, and OpenCV's threads would occupy its cores.
  cv::setNumThreads(1);
  const auto text = run(arguments);
  if (text) {
    std::cout << *text;
    return static_cast<int>(ExitStatus::Done);
  }
  std::fprintf(stderr, "%s: %s\n", name, text.error().message.c_str());
  return static_cast<int>(text.error().status);
} catch (const std::bad_alloc&) {
  std::fprintf(stderr, "%s: not enough memory for pictures of this size\n", name);
  return static_cast<int>(ExitStatus::Failed);
}

}  // namespace orbwatch::app::cli
