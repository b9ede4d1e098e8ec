// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>
#include <vector>

#include "app/cli/bench/bench_figures.h"
#include "app/model/sink/sink.h"

namespace orbwatch::app::cli {

/// Keeps the figures of each frame set while it records. Its memory is bounded: figures beyond it
/// are counted but not ranked.
/// Thread rule: as Sink; the rest on the thread that started it.
class BenchSink final : public Sink {
 public:
  /// Reserves memory for `seconds` of up to kMostPerSecond frame sets.
  explicit BenchSink(double seconds);

  static constexpr double kMostPerSecond = 250;

  Result<> start() override { return {}; }
  void stop() override {}
  /// Requests every view in colour, as if it were read.
  PictureNeeds needs(std::size_t /*view*/, hal::TimePoint /*stamp*/) override {
    return need_of(PixelFormat::Rgb);
  }
  void accept(const ViewPtr& view) override;
  void accept(const Status& status) override;

  /// Starts a new recording.
  void record();
  /// Ends the recording and fills in its figures: rates and names are the caller's.
  void report(BenchFigures& figures);

  Status newest() const;

 private:
  /// Samples of one figure.
  class Samples {
   public:
    void reserve(std::size_t count) { values_.reserve(count); }
    void clear();
    void add(double value);
    double mean() const { return count_ == 0 ? 0 : sum_ / static_cast<double>(count_); }
    Percentiles ranked() { return percentiles(values_); }

   private:
    std::vector<float> values_;
    double sum_ = 0;
    std::size_t count_ = 0;
  };

  mutable std::mutex mutex_;  ///< held only while figures are copied
  bool records_ = false;
  Status first_;  ///< status at the start of the recording
  Status newest_;
  Samples busy_;
  std::array<Samples, kStages> stages_;
  std::array<Samples, kMaxViews> latencies_;
};

}  // namespace orbwatch::app::cli
