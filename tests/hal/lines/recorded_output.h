// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "hal/lines/line.h"

namespace orbwatch::hal {

/// Output that records the levels set, with the tests' time.
class RecordedOutput : public DigitalOutput {
 public:
  struct Record {
    TimePoint now;  ///< set by the test
    std::vector<EdgeEvent> changes;
    bool is_broken = false;
  };

  explicit RecordedOutput(std::shared_ptr<Record> record) : record_(std::move(record)) {}

  LineResult<> set(bool active) override {
    if (record_->is_broken) return tl::unexpected(LineFaultReport{LineFault::Gone, {}});
    record_->changes.push_back({edge_to(active), record_->now});
    return {};
  }

 private:
  std::shared_ptr<Record> record_;
};

}  // namespace orbwatch::hal
