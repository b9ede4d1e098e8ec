// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/paired_run.h"

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <numeric>

namespace orbwatch::bench {
namespace {

double milliseconds_of(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) / 1e6;
}

/// CPU time of one run's thread, and of the whole process meanwhile.
struct Cost {
  double thread;
  double process;
};
Cost cost_of(const std::function<void()>& run) {
  const double process = milliseconds_of(CLOCK_PROCESS_CPUTIME_ID);
  const double thread = milliseconds_of(CLOCK_THREAD_CPUTIME_ID);
  run();
  const double done = milliseconds_of(CLOCK_THREAD_CPUTIME_ID);
  return {done - thread, milliseconds_of(CLOCK_PROCESS_CPUTIME_ID) - process};
}

}  // namespace

std::string run_by_turns(std::vector<Contestant>& contestants, int repetitions) {
  std::vector<double> elsewhere(contestants.size());
  for (Contestant& contestant : contestants) contestant.run();
  for (int i = 0; i < repetitions; ++i) {
    for (std::size_t turn = 0; turn < contestants.size(); ++turn) {
      const std::size_t who = (turn + i) % contestants.size();
      const Cost cost = cost_of(contestants[who].run);
      contestants[who].milliseconds.push_back(cost.thread);
      elsewhere[who] += cost.process - cost.thread;
    }
  }
  constexpr double kNegligible = 0.02;
  for (std::size_t who = 0; who < contestants.size(); ++who) {
    const auto& times = contestants[who].milliseconds;
    if (elsewhere[who] > kNegligible * std::accumulate(times.begin(), times.end(), 0.0)) {
      return contestants[who].name + " ran on other threads too";
    }
  }
  return {};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double paired_ratio(const Contestant& peer, const Contestant& ours) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < ours.milliseconds.size(); ++i) {
    ratios.push_back(peer.milliseconds[i] / ours.milliseconds[i]);
  }
  return median(std::move(ratios));
}

}  // namespace orbwatch::bench
