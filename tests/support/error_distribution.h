// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace orbwatch::tests {

/// The absolute errors of one figure over many scenes.
class ErrorDistribution {
 public:
  explicit ErrorDistribution(std::string name) : name_(std::move(name)) {}

  void add(double error) { errors_.push_back(std::abs(error)); }

  std::size_t size() const { return errors_.size(); }

  /// The error below which this share of the scenes lies. NaN counts as infinite.
  double quantile(double share) const {
    std::vector<double> sorted = errors_;
    std::ranges::for_each(sorted, [](double& e) { e = std::isnan(e) ? HUGE_VAL : e; });
    std::ranges::sort(sorted);
    if (sorted.empty()) return HUGE_VAL;
    const double place = share * static_cast<double>(sorted.size() - 1);
    return sorted[static_cast<std::size_t>(std::lround(place))];
  }
  double p50() const { return quantile(0.5); }
  double p95() const { return quantile(0.95); }
  double max() const { return quantile(1); }

  /// Prints the figures and records them in the test's report, which also gets each fiftieth of
  /// them; tests/acceptance/plot draws these.
  void report() const {
    char line[160];
    std::snprintf(line, sizeof line, "%-34s n %4zu  p50 %9.4g  p95 %9.4g  max %9.4g", name_.c_str(),
                  size(), p50(), p95(), max());
    std::puts(line);
    testing::Test::RecordProperty(name_, line);
    testing::Test::RecordProperty("quantiles of " + name_, quantiles());
  }

 private:
  std::string quantiles() const {
    std::string text;
    for (int n = 0; n <= 50; ++n) {
      char number[32];
      std::snprintf(number, sizeof number, "%s%.4g", n == 0 ? "" : " ", quantile(n / 50.0));
      text += number;
    }
    return text;
  }

  std::string name_;
  std::vector<double> errors_;
};

}  // namespace orbwatch::tests
