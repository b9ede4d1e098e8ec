// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace orbwatch::bench {

/// Number of repetitions of each of the bench's contestants; main() sets it.
inline int pairs = 31;

/// A contestant of a paired run, with the time of each of its repetitions.
struct Contestant {
  std::string name;
  std::function<void()> run;
  std::vector<double> milliseconds;
};

/// Runs the same work of all contestants alternately, `repetitions` times after one round that is
/// not counted, beginning with another one each time: a slow machine slows all of them down.
/// Measures thread CPU time. Error, as text: a contestant that kept other threads busy, whose time
/// would be no measure. Empty on success.
std::string run_by_turns(std::vector<Contestant>& contestants, int repetitions);

double median(std::vector<double> values);

/// The median of peer / ours over the repetitions: the factor by which ours is faster.
double paired_ratio(const Contestant& peer, const Contestant& ours);

}  // namespace orbwatch::bench
