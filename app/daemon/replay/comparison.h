// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/ports/recorder/messages.h"

namespace orbwatch::app::daemon {

/// A value that is not as it was recorded.
struct Difference {
  std::uint64_t utc = 0;  ///< stamp of the frame set, ns since 1970
  std::uint64_t frame_set = 0;
  std::string kind, name;  ///< of the component
  std::string figure;
  double recorded = 0, computed = 0;  ///< NaN: not valid
  bool is_of_jpeg = false;            ///< JPEG explains it, see kJpegTolerances
};

/// Figures of a comparison.
struct ComparisonCounts {
  static constexpr std::size_t kMostMissing = 1000;  ///< a recording of any origin may name more

  std::size_t sets = 0;
  std::size_t values = 0;
  std::size_t differences = 0;
  std::size_t of_jpeg = 0;        ///< further ones, which JPEG explains
  std::size_t not_measured = 0;   ///< regions that were not measured when they were recorded
  std::set<std::string> missing;  ///< components of one side alone, such as "region weld"
};

/// Regions that were measured in pictures which the recorder coded as JPEG: its quality, by recipe
/// and region.
using JpegQualities = std::map<std::pair<std::uint16_t, std::string>, int>;

/// Compares the regions and alarms of computed states with the recorded ones, set by set. An alarm
/// whose state changes one set earlier or later is as recorded, because delays count from the
/// moment at which a set was processed.
class Comparison {
 public:
  using OnDifference = std::function<void(const Difference&)>;

  /// `tolerance`: share of the larger value by which two may differ; 0: they must be equal.
  Comparison(double tolerance, JpegQualities qualities, OnDifference on_difference)
      : tolerance_(tolerance),
        qualities_(std::move(qualities)),
        on_difference_(std::move(on_difference)) {}

  void add(std::uint64_t utc, const recorder::ProcessState& recorded,
           const recorder::ProcessState& computed);
  /// Ends the comparison.
  const ComparisonCounts& finish();

 private:
  void compare(const recorder::ComponentFigures& recorded,
               const recorder::ComponentFigures& computed, Difference place, std::uint16_t recipe);
  void add_missing(const recorder::ComponentFigures& component);
  void settle(const recorder::ProcessState& recorded);
  void report(const Difference& difference);
  bool is_same(double recorded, double computed) const;
  bool is_of_jpeg(const Difference& difference, std::uint16_t recipe) const;

  double tolerance_;
  JpegQualities qualities_;
  OnDifference on_difference_;
  ComparisonCounts counts_;
  recorder::ProcessState before_;      ///< recorded for the set before
  std::vector<Difference> unsettled_;  ///< of alarms of the set before: the next one decides
};

}  // namespace orbwatch::app::daemon
