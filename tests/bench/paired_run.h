#pragma once

#include <functional>
#include <string>
#include <vector>

namespace orbwatch::bench {

/// How often each of the bench's contestants does its work; main() sets it.
inline int pairs = 31;

/// Who takes part in a paired run, and how long each of its repetitions took.
struct Contestant {
  std::string name;
  std::function<void()> run;
  std::vector<double> milliseconds;
};

/// Lets all of them do the same work by turns, `repetitions` times after one round that does not
/// count, beginning with another one each time: whatever slows the machine down slows them all.
/// Takes thread CPU time. Error, as text: a contestant that kept other threads busy, whose time
/// would be no measure. Empty when all is well.
std::string run_by_turns(std::vector<Contestant>& contestants, int repetitions);

double median(std::vector<double> values);

/// The median of peer / ours, repetition by repetition: how many times faster ours is.
double paired_ratio(const Contestant& peer, const Contestant& ours);

}  // namespace orbwatch::bench
